#include "core/export/scan_surfaces.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/surface/seen_part.hpp"
#include "core/surface/surface_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

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
  const bool closed = topology(s.surface.mesh).watertight();
  Json json = {{"summary", summary(s)},
               {"triangles", s.surface.mesh.triangles.size()},
               {"area_m2", s.surface.mesh.surface_area()},
               {"area_seen_m2", area.seen},
               {"area_unseen_m2", area.unseen},
               {"closed", closed},
               {"watertight", closed && !(area.unseen > 0.0)},
               {"openings", s.openings.size()},
               {"longest_openings", openings}};
  if (s.surface_error) json["surface_error"] = to_json(*s.surface_error);
  return json;
}

/// What of a session surfaces are made of. @throws Stopped
ReconstructionInput input_of(const Session& session, const std::stop_token& stop) {
  std::vector<const Scan*> scans;
  for (const auto& scan : session.scans()) scans.push_back(scan.get());
  const KnownObject* known = session.known_object();
  return {session.map().grid(),
          session.planning_voxels(),
          session.refinement() ? std::optional(session.configuration().gibbs.sampler.prior) : std::nullopt,
          std::move(scans),
          known ? session.mesh().get() : nullptr,
          known ? &known->samples() : nullptr,
          known ? known->visible(stop) : std::span<const std::uint8_t>{},
          session.configuration().object.ground};
}

}  // namespace

std::vector<ScanSurface> scan_surfaces(const Session& session, const Progress& progress, std::stop_token stop) {
  return scan_surfaces(input_of(session, stop), progress, stop);
}

ScanSurface scan_surface(const Session& session, SurfaceSource source, const MapOfViews* wanted,
                         const Progress& progress, const std::stop_token& stop) {
  ReconstructionInput input = input_of(session, stop);
  input.true_mesh = nullptr;
  if (wanted) input.voxels = wanted->map.voxels(), input.prior = wanted->prior;
  return scan_surface(input, source, progress, stop);
}

std::vector<ScanSurface> scan_surfaces(const RefinementJob& job, const Refinement& refinement, const Progress& progress,
                                       std::stop_token stop) {
  const RefinementTruth* truth = job.truth ? &*job.truth : nullptr;
  std::vector<const Scan*> scans;
  for (const Scan& scan : job.scans) scans.push_back(&scan);
  return scan_surfaces({job.grid, refinement.refined, job.sampler.prior, scans, truth ? truth->mesh.get() : nullptr,
                        truth ? &truth->samples : nullptr,
                        truth ? std::span<const std::uint8_t>(truth->visible) : std::span<const std::uint8_t>{},
                        job.configuration.object.ground},
                       progress, std::move(stop));
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
  write_file(claim("surfaces.json"), json_text(json, 2) + "\n");
  return names;
}

}  // namespace nextview
