// The files of a refinement and of a calibration: each number under its name. The numbers are made up, all different,
// so that one in another's place shows.
#include "core/export/refinement_files.hpp"

#include <nlohmann/json.hpp>

#include "core/export/map_calibration_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/offline/map_calibration.hpp"
#include "core/offline/refinement.hpp"
#include "tests/unit/export/csv_table.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"

namespace nextview {
namespace {

/// Counts up: no two numbers are the same.
class Different {
 public:
  double share() { return double(++count_) / 1024.0; }
  std::size_t whole() { return ++count_; }

 private:
  std::size_t count_ = 0;
};

MapQuality quality(Different& next) {
  MapQuality q;
  q.voxels = next.whole();
  q.log_loss = next.share(), q.brier = next.share(), q.divergence = next.share();
  q.divergence_outside_band = next.share(), q.calibration_error = next.share();
  return q;
}

MapScores scores(Different& next) {
  MapScores s{quality(next), quality(next), quality(next), quality(next), next.share(), {}};
  s.openings.rows = 1000, s.openings.open_rows = next.whole();
  s.openings.free_voxels = 1000, s.openings.called_free = next.whole();
  s.openings.control_rows = 1000, s.openings.leaking_rows = next.whole();
  return s;
}

void expect_quality(const nlohmann::json& json, const MapQuality& q) {
  EXPECT_EQ(json.size(), 6u);
  EXPECT_EQ(json["voxels"], q.voxels);
  EXPECT_EQ(json["log_loss_nats"], q.log_loss);
  EXPECT_EQ(json["brier"], q.brier);
  EXPECT_EQ(json["d_kl_nats"], q.divergence);
  EXPECT_EQ(json["d_kl_outside_band"], q.divergence_outside_band);
  EXPECT_EQ(json["expected_calibration_error"], q.calibration_error);
}

void expect_scores(const nlohmann::json& json, const MapScores& s) {
  expect_quality(json["touch truth"]["visited band"], s.touch_band);
  expect_quality(json["touch truth"]["visited"], s.touch_visited);
  expect_quality(json["centre truth"]["visited band"], s.centre_band);
  expect_quality(json["centre truth"]["visited"], s.centre_visited);
  EXPECT_EQ(json["surface_recall_touch"], *s.surface_recall);
  EXPECT_EQ(json["openings_centre"]["row_openness"], double(s.openings.open_rows) / 1000);
  EXPECT_EQ(json["openings_centre"]["recall"], double(s.openings.called_free) / 1000);
  EXPECT_EQ(json["openings_centre"]["leaks"], double(s.openings.leaking_rows) / 1000);
}

class RefinementFiles : public InTemporaryFolder {
 protected:
  RefinementFiles() {
    SamplerDiagnostics& d = refinement.posterior.diagnostics;
    d.log_posterior = {{-9, -8, -7}, {-6, -5, -4}};
    d.changed_voxels = {{90, 80, 70}, {60, 50, 40}};
    d.burn_in = 1;
    for (std::size_t* n : {&d.measured_rays, &d.merged_rays, &d.observed_voxels, &d.informed_voxels, &d.incidences,
                           &d.list_bytes, &d.chain_bytes, &d.disagreeing_voxels})
      *n = next.whole();
    for (double* x : {&d.r_hat, &d.effective_samples, &d.trend, &d.voxel_r_hat, &d.voxel_effective_samples,
                      &refinement.rank_correlation})
      *x = next.share();
    d.sweeps = 3, d.divergence = {0.5, 0.25}, d.warning = "a warning", d.stationary = true;
    d.build_seconds = 1.5, d.sample_seconds = 2.25;
    refinement.gains_before = {next.share(), next.share()}, refinement.gains_after = {next.share(), next.share()};
    refinement.scores_before = scores(next), refinement.scores_after = scores(next);
    refinement.posterior.grid = job.grid;
    refinement.posterior.occupied = {0.25f, 0.75f}, refinement.posterior.informed = {1, 1};
    refinement.posterior.touch = {0.125f, 0.875f}, refinement.posterior.centre = {0.0f, 0.5f};
    job.name = "thing", job.scans.resize(7), job.configuration.seed = 3;
    OutputFolder out = begun(folder_);
    write_refinement(job, refinement, out);
  }
  static RefinementJob job_of_two_voxels() {
    RefinementJob job;
    job.grid = {0.01, {0, 0, 0}, {2, 1, 1}};
    return job;
  }
  Different next;
  RefinementJob job = job_of_two_voxels();
  Refinement refinement{OccupancyMap(job.grid, job.model), {}, VoxelBricks(), {}, {}, 0.0, {}, {}};
};

TEST_F(RefinementFiles, ScoresAreBeforeAndAfter) {
  const CsvTable table(folder_ / "scores.csv");
  ASSERT_EQ(table.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(table.number(v, "view"), double(v));
    EXPECT_EQ(table.number(v, "gain_before[nats]"), refinement.gains_before[v]);
    EXPECT_EQ(table.number(v, "gain_after[nats]"), refinement.gains_after[v]);
  }
}

TEST_F(RefinementFiles, TheTraceHasEverySweepOfEveryChain) {
  const CsvTable table(folder_ / "trace.csv");
  ASSERT_EQ(table.size(), 6u);
  for (std::size_t row = 0; row < 6; ++row) {
    EXPECT_EQ(table.number(row, "chain"), double(row / 3));
    EXPECT_EQ(table.number(row, "sweep"), double(row % 3 + 1));
    EXPECT_EQ(table.number(row, "log_posterior[nats]"), double(row) - 9);
    EXPECT_EQ(table.number(row, "changed_voxels"), 90.0 - 10.0 * double(row));
    EXPECT_EQ(table.number(row, "in_mean"), row % 3 >= 1 ? 1.0 : 0.0) << "the first sweep is burn-in";
  }
}

TEST_F(RefinementFiles, MetricsHaveEachNumberUnderItsName) {
  const auto json = nlohmann::json::parse(read_file(folder_ / "metrics.json"));
  EXPECT_EQ(json["name"], "thing");
  EXPECT_EQ(json["views"], 7);
  EXPECT_EQ(json["model"], "attenuation");
  EXPECT_EQ(json["rank_correlation_of_candidates"], refinement.rank_correlation);
  expect_scores(json["conventional"], *refinement.scores_before);
  expect_scores(json["gibbs"], *refinement.scores_after);
  const SamplerDiagnostics& d = refinement.posterior.diagnostics;
  const auto& found = json["diagnostics"];
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, std::size_t>>{{"measured_rays", d.measured_rays},
                                                        {"merged_rays", d.merged_rays},
                                                        {"observed_voxels", d.observed_voxels},
                                                        {"informed_voxels", d.informed_voxels},
                                                        {"incidences", d.incidences},
                                                        {"list_bytes", d.list_bytes},
                                                        {"chain_bytes", d.chain_bytes},
                                                        {"disagreeing_voxels", d.disagreeing_voxels},
                                                        {"sweeps", 3},
                                                        {"burn_in", 1}})
    EXPECT_EQ(found[name], value) << name;
  EXPECT_EQ(found["r_hat"], d.r_hat);
  EXPECT_EQ(found["effective_samples"], d.effective_samples);
  EXPECT_EQ(found["trend_z"], d.trend);
  EXPECT_EQ(found["voxel_r_hat_percentile_95"], d.voxel_r_hat);
  EXPECT_EQ(found["voxel_effective_samples_percentile_5"], d.voxel_effective_samples);
  EXPECT_EQ(found["divergence_of_means_nats"], nlohmann::json({0.5, 0.25}));
  EXPECT_EQ(found["stationary"], true);
  EXPECT_EQ(found["warning"], "a warning");
}

TEST_F(RefinementFiles, TimingsAndConfiguration) {
  const CsvTable timings(folder_ / "timings.csv");
  EXPECT_EQ(timings.number(0, "lists[s]"), 1.5);
  EXPECT_EQ(timings.number(0, "sweeps[s]"), 2.25);
  EXPECT_TRUE(read_file(folder_ / "config.toml").starts_with("seed = 3"));
}

class CalibrationFiles : public InTemporaryFolder {};

TEST_F(CalibrationFiles, ScoresAndDescentHaveEachNumberUnderItsName) {
  Different next;
  MapCalibration calibration;
  for (int i = 0; i < 3; ++i) {
    InverseSensorModel m;
    m.hit = 0.5 + 0.25 * next.share(), m.miss = 0.25 * next.share(), m.hit_decay = next.share();
    m.miss_decay = next.share(), m.clamp_min = next.share() / 1024, m.clamp_max = 1.0 - next.share() / 1024;
    calibration.fit.descent.push_back({next.share(), next.share(), m});
  }
  calibration.fit.model = calibration.fit.descent.back().model;
  calibration.fit.cross_entropy_before = next.share(), calibration.fit.cross_entropy = next.share();
  calibration.fit.termination = "it ended", calibration.fit.converged = true;
  calibration.config.band = 2, calibration.config.fit.clamps = true;
  ExampleScores e;
  e.name = "thing", e.views = next.whole(), e.voxels = next.whole(), e.held_out = true, e.gibbs_stationary = true;
  e.cross_entropy_before = next.share(), e.cross_entropy_after = next.share(), e.gibbs_entropy = next.share();
  e.before = scores(next), e.after = scores(next), e.gibbs = scores(next);
  calibration.examples = {e};
  OutputFolder out = begun(folder_);
  write_map_calibration(calibration, "remark", out);

  const CsvTable descent(folder_ / "descent.csv"), table(folder_ / "scores.csv");
  for (std::size_t i = 0; i < 3; ++i) {
    const CalibrationStep& s = calibration.fit.descent[i];
    for (const auto& [column, value] :
         std::vector<std::pair<const char*, double>>{{"iteration", double(i)},
                                                     {"cross_entropy[nats]", s.cross_entropy},
                                                     {"gradient_norm", s.gradient_norm},
                                                     {"hit", s.model.hit},
                                                     {"miss", s.model.miss},
                                                     {"hit_decay[1/m]", s.model.hit_decay},
                                                     {"miss_decay[1/m]", s.model.miss_decay},
                                                     {"clamp_min", s.model.clamp_min},
                                                     {"clamp_max", s.model.clamp_max}})
      EXPECT_EQ(descent.number(i, column), value) << column;
  }
  const std::array maps = {std::tuple("before", e.cross_entropy_before, e.before),
                           std::tuple("after", e.cross_entropy_after, e.after),
                           std::tuple("gibbs", e.gibbs_entropy, e.gibbs)};
  ASSERT_EQ(table.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& [map, cross_entropy, s] = maps[row];
    EXPECT_EQ(table.text(row, "map"), map);
    EXPECT_EQ(table.text(row, "object"), "thing");
    for (const auto& [column, value] :
         std::vector<std::pair<const char*, double>>{{"views", double(e.views)},
                                                     {"held_out", 1},
                                                     {"voxels", double(e.voxels)},
                                                     {"cross_entropy[nats]", *cross_entropy},
                                                     {"log_loss_touch_near_surface[nats]", s->touch_band.log_loss},
                                                     {"brier_touch_near_surface", s->touch_band.brier},
                                                     {"log_loss_centre_near_surface[nats]", s->centre_band.log_loss},
                                                     {"log_loss_touch_visited[nats]", s->touch_visited.log_loss},
                                                     {"d_kl_touch_visited[nats]", s->touch_visited.divergence},
                                                     {"surface_recall", *s->surface_recall},
                                                     {"rows_open", double(s->openings.open_rows) / 1000},
                                                     {"opening_recall", double(s->openings.called_free) / 1000},
                                                     {"leaks", double(s->openings.leaking_rows) / 1000}})
      EXPECT_EQ(table.number(row, column), value) << map << ", " << column;
  }
  const auto json = nlohmann::json::parse(read_file(folder_ / "calibration.json"));
  EXPECT_EQ(json["cross_entropy_before_nats"], calibration.fit.cross_entropy_before);
  EXPECT_EQ(json["cross_entropy_after_nats"], calibration.fit.cross_entropy);
  EXPECT_EQ(json["band_voxels"], 2);
  EXPECT_EQ(json["clamps_fitted"], true);
  EXPECT_EQ(json["range_dependent"], false);
  EXPECT_EQ(json["converged"], true);
  EXPECT_EQ(json["termination"], "it ended");
  EXPECT_EQ(json["examples"][0]["views"], e.views);
  EXPECT_EQ(json["examples"][0]["voxels"], e.voxels);
  EXPECT_EQ(json["examples"][0]["held_out"], true);
}

}  // namespace
}  // namespace nextview
