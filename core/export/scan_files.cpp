#include "core/export/scan_files.hpp"

#include <fmt/format.h>

#include "core/evaluation/accuracy.hpp"
#include "core/evaluation/openings.hpp"
#include "core/export/scan_tables.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/map/octree_file.hpp"
#include "core/session/timings.hpp"

namespace nextview {
namespace {

std::string scores_csv(const Session& session) {
  const bool refined = session.refinement() != nullptr;
  const GainColumn gain(session);
  std::string csv = fmt::format("step,view,available,{},cost[m],utility,seconds[s]{}{}\n", gain.name(),
                                refined ? ",gain_on_conventional_map[nats]" : "", gain.unit_name());
  for (const StepRecord& r : session.records())
    for (std::size_t v = 0; v < r.candidates.size(); ++v) {
      const Candidate& c = r.candidates[v];
      csv += fmt::format("{},{},{},{},{},{},{}", r.step, v, int(c.available), c.gain, c.cost, c.utility, c.seconds);
      const bool compared = r.refinement && !r.refinement->conventional_gains.empty();
      if (refined) csv += compared ? fmt::format(",{}", r.refinement->conventional_gains[v]) : ",";
      csv += gain.unit(r.ranking.gain_unit) + "\n";
    }
  return csv;
}

/// What each refinement of the map did; gain gibbs only.
std::string refinement_csv(const Session& session) {
  std::string csv =
      "step,merged_rays,informed_voxels,changed_class,sweeps,r_hat,trend_z,disagreeing_voxels,stationary,"
      "conventional_next_view,rank_correlation,log_loss_near_surface[nats],brier_near_surface\n";
  for (const StepRecord& r : session.records()) {
    if (!r.refinement) continue;  // that step was ranked by another gain
    const RefinementRecord& n = *r.refinement;
    const SamplerDiagnostics& d = n.diagnostics;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.step, d.merged_rays, d.informed_voxels,
                       n.changed_class, d.sweeps, d.r_hat, d.trend, d.disagreeing_voxels, int(d.stationary),
                       n.conventional_best ? fmt::format("{}", *n.conventional_best) : "", n.rank_correlation,
                       n.quality_near_surface.log_loss, n.quality_near_surface.brier);
  }
  return csv;
}

/// Of a recording: which frame was taken when, and how soon other orders would have shown as much.
std::string orders_csv(const Session& session) {
  const std::vector<std::size_t> taken = frames_taken(session.state().known);
  const RecordedSurface& surface = *session.setup().recorded;
  std::string csv = "views,frame,name,coverage,coverage_in_recorded_order,coverage_in_random_order\n";
  if (taken.empty()) return csv;
  const CoverageByOrder orders = surface.compare_orders(taken, session.configuration().seed);
  for (std::size_t k = 0; k < surface.frames(); ++k) {
    const bool was_taken = k < taken.size();
    csv += fmt::format("{},{},{},{},{},{}\n", k + 1, was_taken ? fmt::format("{}", taken[k]) : "",
                       was_taken ? session.recording()->frames[taken[k]].name : "",
                       was_taken ? fmt::format("{}", orders.planned[k]) : "", orders.recorded[k], orders.random[k]);
  }
  return csv;
}

nlohmann::ordered_json to_json(const MapQuality& q) {
  return {{"voxels", q.voxels},
          {"log_loss_nats", q.log_loss},
          {"brier", q.brier},
          {"d_kl_nats", q.divergence},
          {"d_kl_outside_band", q.divergence_outside_band},
          {"expected_calibration_error", q.calibration_error}};
}

/// The evaluation as it stands after the last view, each number with what it is over.
nlohmann::ordered_json evaluation_json(const Session& session, const PointCloud& cloud) {
  const KnownObject& object = *session.known_object();
  const StepRecord& last = session.records().back();
  nlohmann::ordered_json json;
  json["coverage"] = {{"d_reg_m", session.configuration().evaluation.d_reg},
                      {"of_all_surface", last.coverage},
                      {"of_visible_surface", last.coverage_visible},
                      {"of_all_surface_at_0.5_mm", last.coverage_paper}};
  if (last.coverage_any_pose) json["coverage_any_pose"] = *last.coverage_any_pose;
  if (!cloud.empty()) {
    const Accuracy a = accuracy(cloud, MeshDistance(*session.mesh()));
    json["accuracy_m"] = {{"points", a.points}, {"mean", a.mean}, {"rms", a.rms}, {"percentile_95", a.percentile_95}};
  }
  const VoxelBricks& voxels = session.map().voxels();
  const BitMask& visited = session.evaluation()->visited_voxels;
  constexpr std::array sets = {ScoredSet::visited, ScoredSet::visited_band, ScoredSet::region};
  for (const TruthConvention convention : {TruthConvention::touch, TruthConvention::centre}) {
    nlohmann::ordered_json& of_map = json["map"][std::string(name(convention)) + " truth"];
    const std::vector<MapQuality> qualities = map_quality(voxels, object.truth(), convention, sets, visited);
    for (std::size_t s = 0; s < sets.size(); ++s) of_map[std::string(name(sets[s]))] = to_json(qualities[s]);
    const auto recall = surface_recall(voxels, object.truth(), convention, visited);
    if (recall) of_map["surface_recall"] = *recall;
  }
  return json;
}

std::string metrics_json(const Session& session, const PointCloud& cloud) {
  const auto& records = session.records();
  double path = 0.0, rotation = 0.0;
  for (const StepRecord& r : records) {
    path += r.motion.distance;
    rotation += r.motion.rotation;
  }
  nlohmann::ordered_json json = {
      {"object", session.object_file().empty() ? session.name() : session.object_file().filename().string()},
      {"gain", session.configuration().planner.gain},
      {"views", records.size()},
      {"finished", session.finished()},
      {"path_m", path},
      {"rotation_rad", rotation}};
  if (const auto& alignment = session.truth_alignment())
    json["alignment"] = {{"residual_m", alignment->residual}, {"overlap", alignment->overlap}};
  if (!records.empty()) {
    if (records.back().coverage_recorded) json["coverage_recorded"] = *records.back().coverage_recorded;
    json["entropy_bits"] = records.back().entropy;
    json["total_entropy_bits"] = records.back().total_entropy;
    if (records.back().surface_left) json["surface_left"]["expected_share"] = *records.back().surface_left;
    if (session.known_object() && !session.recording())
      json["surface_left"]["true_share"] = 1.0 - records.back().coverage_visible;
    if (session.known_object()) json.update(evaluation_json(session, cloud));
  }
  return json_text(json, 2) + "\n";
}

}  // namespace

void write_scan(const Session& session, OutputFolder& out) {
  PointCloud cloud;
  for (const auto& scan : session.scans()) cloud.insert(cloud.end(), scan->hits.begin(), scan->hits.end());
  write_file(out.claim("config.toml"), to_toml(session.configuration(), out.path()));
  write_file(out.claim("steps.csv"), steps_csv(session));
  write_file(out.claim("scores.csv"), scores_csv(session));
  write_file(out.claim("views.csv"), views_csv(session));
  write_file(out.claim(timings_name), timings_csv(session));
  if (session.recording()) write_file(out.claim("orders.csv"), orders_csv(session));
  write_file(out.claim("metrics.json"), metrics_json(session, cloud));
  write_octree(session.map(), out.claim("map.ot"));
  write_octree(session.map(), out.claim("map.bt"));
  write_ply(cloud, out.claim("cloud.ply"));
  if (!session.refinement()) return;
  write_file(out.claim("refinement.csv"), refinement_csv(session));
  write_octree(to_occupancy_map(session.refinement()->posterior(), session.map().model()), out.claim("posterior.ot"));
}

}  // namespace nextview
