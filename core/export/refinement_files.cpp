#include "core/export/refinement_files.hpp"

#include <fmt/format.h>

#include "core/export/diagnostics_text.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/map/octree_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

std::string scores_csv(const Refinement& r) {
  std::string csv = "view,gain_before[nats],gain_after[nats]\n";
  for (std::size_t v = 0; v < r.gains_after.size(); ++v)
    csv += fmt::format("{},{},{}\n", v, r.gains_before[v], r.gains_after[v]);
  return csv;
}

std::string trace_csv(const SamplerDiagnostics& d) {
  std::string csv = "chain,sweep,log_posterior[nats],changed_voxels,in_mean\n";
  for (std::size_t c = 0; c < d.log_posterior.size(); ++c)
    for (std::size_t s = 0; s < d.log_posterior[c].size(); ++s)
      csv += fmt::format("{},{},{},{},{}\n", c, s + 1, d.log_posterior[c][s], d.changed_voxels[c][s],
                         int(int(s) >= d.burn_in));
  return csv;
}

Json share(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json to_json(const MapScores& scores) {
  const auto quality = [](const MapQuality& q) {
    return Json{{"voxels", q.voxels},
                {"log_loss_nats", q.log_loss},
                {"brier", q.brier},
                {"d_kl_nats", q.divergence},
                {"d_kl_outside_band", q.divergence_outside_band},
                {"expected_calibration_error", q.calibration_error}};
  };
  return {
      {"touch truth", {{"visited band", quality(scores.touch_band)}, {"visited", quality(scores.touch_visited)}}},
      {"centre truth", {{"visited band", quality(scores.centre_band)}, {"visited", quality(scores.centre_visited)}}},
      {"surface_recall_touch", share(scores.surface_recall)},
      {"openings_centre",
       {{"row_openness", share(scores.openings.row_openness())},
        {"recall", share(scores.openings.recall())},
        {"leaks", share(scores.openings.leaks())}}}};
}

std::string metrics_json(const RefinementJob& job, const Refinement& r) {
  Json json = {{"name", job.name}, {"views", job.scans.size()}, {"model", name(job.sampler.model.kind)}};
  json["diagnostics"] = parse_json<Json>(diagnostics_json(r.posterior.diagnostics));
  json["rank_correlation_of_candidates"] = r.rank_correlation;
  if (r.scores_before) json["conventional"] = to_json(*r.scores_before);
  if (r.scores_after) json["gibbs"] = to_json(*r.scores_after);
  return json_text(json, 2) + "\n";
}

}  // namespace

void write_refinement(const RefinementJob& job, const Refinement& r, OutputFolder& out) {
  const SamplerDiagnostics& d = r.posterior.diagnostics;
  write_file(out.claim("config.toml"), to_toml(job.configuration, out.path()));
  write_file(out.claim("scores.csv"), scores_csv(r));
  write_file(out.claim("trace.csv"), trace_csv(d));
  write_file(out.claim("metrics.json"), metrics_json(job, r));
  write_file(out.claim("timings.csv"),
             fmt::format("lists[s],sweeps[s]\n{:.6f},{:.6f}\n", d.build_seconds, d.sample_seconds));
  write_octree(r.conventional, out.claim("conventional.ot"));
  const OccupancyMap map = to_occupancy_map(r.posterior, job.model);
  write_octree(map, out.claim("posterior.ot"));
  write_octree(map, out.claim("posterior.bt"));
}

}  // namespace nextview
