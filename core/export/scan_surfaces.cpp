#include "core/export/scan_surfaces.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/progress/stopped.hpp"
#include "core/surface/cloud_surface.hpp"
#include "core/surface/map_surface.hpp"
#include "core/surface/seen_part.hpp"
#include "core/surface/surface_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

/// The cloud's surface is made in cells of this share of a voxel edge, or larger: see cloud_surface.
constexpr double cloud_cell = 0.2;

/// What surfaces are made of, and compared with.
struct ReconstructionInput {
  const VoxelGrid& grid;
  std::span<const Voxel> voxels;
  std::optional<double> prior;  ///< if the voxels are a Gibbs map's: of a voxel being occupied
  std::vector<const Scan*> scans;
  const TriangleMesh* true_mesh;  ///< null: not known; nor are the samples then
  const SurfaceSamples* samples;
  std::span<const std::uint8_t> visible;
};

/// The hits that lie in the region: strays far off would make the cloud's lattice huge.
std::vector<Scan> within_region(std::span<const Scan* const> scans, const VoxelGrid& grid) {
  const Eigen::AlignedBox3d region(grid.lower(), grid.upper());
  std::vector<Scan> cropped;
  for (const Scan* scan : scans) {
    Scan& kept = cropped.emplace_back();
    kept.origin = scan->origin;
    for (const Eigen::Vector3f& point : scan->hits)
      if (region.contains(point.cast<double>())) kept.hits.push_back(point);
  }
  return cropped;
}

ScanSurface of_map(const ReconstructionInput& input) {
  return {input.prior ? "surface_posterior" : "surface_map",
          input.prior ? "the Gibbs map" : "the occupancy map",
          "Marching cubes at p = 0.5, through the middle of the outermost occupied voxels; closed where no "
          "view has looked.",
          input.prior ? map_surface(input.grid, without_undecided(input.voxels, *input.prior))
                      : map_surface(input.grid, input.voxels),
          {},
          {}};
}

ScanSurface of_cloud(const ReconstructionInput& input, const SurfaceProgress& progress, const std::stop_token& stop) {
  Surface cloud;
  try {
    cloud = cloud_surface(within_region(input.scans, input.grid), cloud_cell * input.grid.resolution, progress, stop);
  } catch (const std::invalid_argument& error) {  // the points do not make one; what the scan found stands all the same
    cloud.why_empty = error.what();
  }
  return {"surface_cloud",
          "the point cloud",
          "Signed distances to the planes of averaged points, integrated; open where no view has looked.",
          std::move(cloud),
          {},
          {}};
}

std::vector<ScanSurface> scan_surfaces(const ReconstructionInput& input, const Progress& progress,
                                       std::stop_token stop) {
  const auto report = [&](double fraction, std::string_view what) {
    if (progress) progress(fraction, what);
    return !stop.stop_requested();
  };
  std::vector<ScanSurface> surfaces;
  if (!report(0.0, "making the map's surface")) return surfaces;
  surfaces.push_back(of_map(input));
  ScanSurface cloud = of_cloud(
      input, [&](double fraction, std::string_view what) { report(0.1 + 0.6 * fraction, what); }, stop);
  if (!stop.stop_requested()) surfaces.push_back(std::move(cloud));

  std::optional<SignedDistance> truth;
  if (input.true_mesh) truth.emplace(*input.true_mesh);
  for (ScanSurface& s : surfaces) {
    if (s.surface.empty()) continue;
    s.openings = boundary_loops(s.surface.mesh);
    if (!truth || !report(0.8, "comparing the surfaces with the true one")) continue;
    s.surface_error = surface_error(s.surface, *truth, *input.samples, input.visible);
  }
  return surfaces;
}

Json to_json(const SurfaceError& i) {
  Json scores = Json::array();
  for (const ThresholdScore& s : i.scores)
    scores.push_back({{"threshold_m", s.threshold},
                      {"accuracy", s.accuracy},
                      {"completeness_visible", s.completeness_visible},
                      {"completeness_all", s.completeness_all},
                      {"f_score", s.f_score}});
  return {{"area_seen_m2", i.area_seen},
          {"area_unseen_m2", i.area_unseen},
          {"bias_m", i.bias},
          {"rms_m", i.rms},
          {"percentile_50_m", i.percentile_50},
          {"percentile_95_m", i.percentile_95},
          {"percentile_99_m", i.percentile_99},
          {"largest_m", i.largest},
          {"thresholds", scores}};
}

Json to_json(const ScanSurface& s) {
  if (s.surface.empty()) return {{"empty", s.surface.why_empty}};
  constexpr std::size_t listed = 20;
  Json openings = Json::array();
  for (const BoundaryLoop& loop : std::span(s.openings).first(std::min(listed, s.openings.size())))
    openings.push_back({{"length_m", loop.length}, {"centre_m", {loop.centre.x(), loop.centre.y(), loop.centre.z()}}});
  const SeenArea area = seen_area(s.surface);
  Json json = {{"summary", summary(s)},
               {"triangles", s.surface.mesh.triangles.size()},
               {"area_m2", s.surface.mesh.surface_area()},
               {"area_seen_m2", area.seen},
               {"area_unseen_m2", area.unseen},
               {"watertight", topology(s.surface.mesh).watertight()},
               {"openings", s.openings.size()},
               {"longest_openings", openings}};
  if (s.surface_error) json["surface_error"] = to_json(*s.surface_error);
  return json;
}

/// What of a session surfaces are made of.
class ReconstructedSession {
 public:
  explicit ReconstructedSession(const Session& session)
      : session_(session), voxels_(session.planning_voxels().dense()) {}

  ReconstructionInput input() const {
    std::vector<const Scan*> scans;
    for (const auto& scan : session_.scans()) scans.push_back(scan.get());
    const KnownObject* known = session_.known_object();
    return {session_.map().grid(),
            voxels_,
            session_.refinement() ? std::optional(session_.configuration().gibbs.sampler.prior) : std::nullopt,
            std::move(scans),
            known ? session_.mesh().get() : nullptr,
            known ? &known->samples() : nullptr,
            known ? known->visible() : std::span<const std::uint8_t>{}};
  }

 private:
  const Session& session_;
  std::vector<Voxel> voxels_;
};

}  // namespace

std::vector<ScanSurface> scan_surfaces(const Session& session, const Progress& progress, std::stop_token stop) {
  const ReconstructedSession reconstructed(session);
  return scan_surfaces(reconstructed.input(), progress, stop);
}

ScanSurface scan_surface(const Session& session, SurfaceSource source, const Progress& progress, std::stop_token stop) {
  const ReconstructedSession reconstructed(session);
  if (progress) progress(0.0, source == SurfaceSource::map ? "making the map's surface" : "making the cloud's surface");
  ScanSurface surface =
      source == SurfaceSource::map ? of_map(reconstructed.input()) : of_cloud(reconstructed.input(), progress, stop);
  throw_if_stopped(stop);
  surface.openings = boundary_loops(surface.surface.mesh);
  return surface;
}

std::vector<ScanSurface> scan_surfaces(const RefinementJob& job, const Refinement& refinement, const Progress& progress,
                                       std::stop_token stop) {
  const RefinementTruth* truth = job.truth ? &*job.truth : nullptr;
  std::vector<const Scan*> scans;
  for (const Scan& scan : job.scans) scans.push_back(&scan);
  const std::vector<Voxel> voxels = refinement.refined.dense();
  return scan_surfaces({job.grid, voxels, job.sampler.prior, scans, truth ? truth->mesh.get() : nullptr,
                        truth ? &truth->samples : nullptr,
                        truth ? std::span<const std::uint8_t>(truth->visible) : std::span<const std::uint8_t>{}},
                       progress, stop);
}

std::string closedness(const Surface& surface, std::span<const BoundaryLoop> openings) {
  const SeenArea area = seen_area(surface);
  if (!(area.unseen > 0.0))
    return fmt::format("{}, {}: {}", summary(openings), openings.empty() ? "all of it seen" : "only what was seen",
                       area.text(area.seen));
  return fmt::format("{}, {}{} of it was seen: {} seen, {} is the hull of what no view saw",
                     openings.empty() ? "closed" : summary(openings), area.seen < area.unseen ? "but only " : "",
                     area.percent_seen(), area.text(area.seen), area.text(area.unseen));
}

std::string summary(const ScanSurface& s) {
  if (s.surface.empty()) return fmt::format("none of {}: {}", s.source, s.surface.why_empty);
  const std::string text = fmt::format("of {}: {}, {}", s.source, counted(s.surface.mesh.triangles.size(), "triangle"),
                                       closedness(s.surface, s.openings));
  if (!s.surface_error) return text;
  return text + fmt::format("; 95 % of what was seen within {:.2f} mm of the true surface",
                            1e3 * s.surface_error->percentile_95);
}

std::vector<std::string> write_surfaces(std::span<const ScanSurface> surfaces, OutputFolder& out) {
  std::vector<std::string> names;
  if (surfaces.empty()) return names;
  const auto claim = [&](const std::string& name) {
    names.push_back(name);
    return out.claim(name);
  };
  Json json;
  for (const ScanSurface& s : surfaces) {
    json[s.name] = to_json(s);
    if (s.surface.empty()) continue;
    write_ply(s.surface, claim(s.name + ".ply"));
    const TriangleMesh seen = seen_part(s.surface), unseen = unseen_part(s.surface);
    if (seen.surface_area() > 0.0) write_stl(seen, claim(s.name + ".stl"), "what was seen");
    if (unseen.surface_area() > 0.0) write_stl(unseen, claim(s.name + "_unseen.stl"), "the hull of what no view saw");
  }
  write_file(claim("surfaces.json"), json.dump(2) + "\n");
  return names;
}

}  // namespace nextview
