#include "core/export/reconstruction.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/file/counted.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/length_text.hpp"
#include "core/surface/map_surface.hpp"
#include "core/surface/seen_part.hpp"

namespace nextview {
namespace {

/// The cloud's surface is made in cells of this share of a voxel edge, or larger: see cloud_surface.
constexpr double cloud_cell = 0.2;

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
          map_surface(input.grid, input.voxels, input.prior),
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

std::optional<SignedDistance> truth_of(const ReconstructionInput& input) {
  return input.true_mesh ? std::optional<SignedDistance>(*input.true_mesh) : std::nullopt;
}

/// Its openings, and how far it lies from the true surface if that is known.
void examine(ScanSurface& found, const ReconstructionInput& input, const std::optional<SignedDistance>& truth) {
  if (found.surface.empty()) return;
  found.openings = boundary_loops(found.surface.mesh);
  if (!truth) return;
  SurfaceErrorOptions options;
  // Made for voxels of 10 mm; of a smaller part, or a larger one, others say as much.
  for (double& threshold : options.thresholds) threshold *= input.grid.resolution / 0.01;
  if (input.on_ground) options.ground = input.true_mesh->bounding_box().min().z();
  found.truth_is_open = topology(*input.true_mesh).boundary_edges > 0;
  found.surface_error = surface_error(found.surface, *truth, *input.samples, input.visible, options);
}

}  // namespace

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

  const std::optional<SignedDistance> truth = truth_of(input);
  std::vector<ScanSurface> whole;
  for (ScanSurface& surface : surfaces) {
    if (!report(0.8, "looking at the surfaces")) break;
    examine(surface, input, truth);
    whole.push_back(std::move(surface));
  }
  return whole;
}

ScanSurface scan_surface(const ReconstructionInput& input, SurfaceSource source, const Progress& progress,
                         const std::stop_token& stop) {
  if (progress) progress(0.0, source == SurfaceSource::map ? "making the map's surface" : "making the cloud's surface");
  ScanSurface surface = source == SurfaceSource::map ? of_map(input) : of_cloud(input, progress, stop);
  throw_if_stopped(stop);
  if (progress) progress(0.8, "looking at the surface");
  examine(surface, input, truth_of(input));
  throw_if_stopped(stop);
  return surface;
}

std::string closedness(const Surface& surface, std::span<const BoundaryLoop> openings) {
  const SeenArea area = seen_area(surface);
  if (!(area.unseen > 0.0))
    return fmt::format("{}, {}: {}", summary(openings), openings.empty() ? "all of it seen" : "only what was seen",
                       area.text(area.seen));
  return fmt::format("{}, {}{} of it was seen: {} seen, {} is the hull of what no ray met",
                     openings.empty() ? "closed" : summary(openings), area.seen < area.unseen ? "but only " : "",
                     area.percent_seen(), area.text(area.seen), area.text(area.unseen));
}

std::string summary(const ScanSurface& s) {
  if (s.surface.empty()) return fmt::format("of {}: none, {}", s.source, s.surface.why_empty);
  std::string text = fmt::format("of {}: {}, {}", s.source, counted(s.surface.mesh.triangles.size(), "triangle"),
                                 closedness(s.surface, s.openings));
  if (!s.surface_error) return text;
  return text + fmt::format("; 95 % of what was seen within {} of the true surface{}",
                            length_text(s.surface_error->percentile_95),
                            s.truth_is_open ? ", whose mesh is not closed: which side of it is a guess" : "");
}

}  // namespace nextview
