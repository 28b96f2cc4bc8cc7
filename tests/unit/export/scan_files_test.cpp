// The files of a scan, each number worked out again from what the session did.
#include "core/export/scan_files.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "core/evaluation/accuracy.hpp"
#include "core/evaluation/openings.hpp"
#include "core/file/atomic_file.hpp"
#include "tests/unit/export/csv_table.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// Some of its surface no candidate sees.
Configuration housing() {
  Configuration c = small_scan();
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply";
  c.map.resolution = 0.02;
  return c;
}

class ScanFiles : public InTemporaryFolder {
 protected:
  /// Four views, the second of them the operator's choice, the third the operator's own.
  void scan(Configuration c) {
    session = std::make_unique<Session>(c);
    session->step();
    session->override_next_view((session->next_candidate().value() + 4) % session->candidates().size());
    session->step();
    session->override_next_view(look_at({0.2, -0.5, 0.7}, Vector3(0.01, 0, 0)));
    session->step();
    session->step();
    OutputFolder out = begun(folder_);
    write_scan(*session, out);
  }
  CsvTable table(const std::string& name) const { return CsvTable(folder_ / name); }
  nlohmann::json metrics() const { return nlohmann::json::parse(read_file(folder_ / "metrics.json")); }
  const StepRecord& record(std::size_t row) const { return session->records().at(row); }

  std::unique_ptr<Session> session;
};

/// Angle of the turn from one pose to another, by its trace [rad].
double turn(const Pose& a, const Pose& b) {
  return std::acos(std::min(1.0, 0.5 * ((a.linear().transpose() * b.linear()).trace() - 1.0)));
}

TEST_F(ScanFiles, StepsTellWhereTheCameraWent) {
  scan(housing());
  const CsvTable steps = table("steps.csv");
  ASSERT_EQ(steps.size(), 4u);
  double path = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose& pose = record(i).T_world_camera;
    const double way = i == 0 ? 0.0 : (pose.translation() - record(i - 1).T_world_camera.translation()).norm();
    path += way;
    EXPECT_EQ(steps.number(i, "step"), double(i + 1));
    EXPECT_NEAR(steps.number(i, "distance[m]"), way, 1e-12);
    EXPECT_NEAR(steps.number(i, "path[m]"), path, 1e-12) << "the ways so far, each once";
    const double angle = i == 0 ? 0.0 : turn(pose, record(i - 1).T_world_camera);
    EXPECT_NEAR(steps.number(i, "rotation[rad]"), angle, 1e-7);
    EXPECT_EQ(steps.number(i, "overridden"), i == 1 || i == 2 ? 1.0 : 0.0);
    EXPECT_EQ(steps.number(i, "view"), i == 0 || i == 2 ? -1.0 : double(record(i).view));
    const auto best = record(i).ranking.best;
    EXPECT_EQ(steps.text(i, "next_view"), best ? std::to_string(*best) : "");
    EXPECT_EQ(steps.number(i, "degenerate"), record(i).ranking.degenerate.empty() ? 0.0 : 1.0);
  }
  EXPECT_EQ(metrics()["path_m"], steps.number(3, "path[m]"));
  double rotation = 0.0;
  for (std::size_t i = 1; i < 4; ++i) rotation += turn(record(i).T_world_camera, record(i - 1).T_world_camera);
  EXPECT_NEAR(metrics()["rotation_rad"], rotation, 1e-6);
}

TEST_F(ScanFiles, StepsHaveTheRecordsNumbersUnderTheirNames) {
  scan(housing());
  const CsvTable steps = table("steps.csv");
  for (std::size_t i = 0; i < 4; ++i) {
    const StepRecord& r = record(i);
    for (const auto& [column, value] :
         std::vector<std::pair<std::string, double>>{{"gain[cm²]", r.gain},
                                                     {"utility", r.utility},
                                                     {"realised_gain[nats]", r.realised_gain},
                                                     {"hits", double(r.hits)},
                                                     {"points", double(r.points)},
                                                     {"misses", double(r.misses)},
                                                     {"new_voxels", double(r.new_voxels)},
                                                     {"entropy[bits]", r.entropy},
                                                     {"total_entropy[bits]", r.total_entropy},
                                                     {"coverage@20mm", r.coverage},
                                                     {"coverage_visible@20mm", r.coverage_visible},
                                                     {"coverage@0.5mm", r.coverage_paper},
                                                     {"d_kl[nats]", r.quality.divergence},
                                                     {"log_loss[nats]", r.quality.log_loss},
                                                     {"brier", r.quality.brier},
                                                     {"log_loss_near_surface[nats]", r.quality_near_surface.log_loss},
                                                     {"brier_near_surface", r.quality_near_surface.brier}})
      EXPECT_EQ(steps.number(i, column), value) << column << ", step " << i + 1;
  }
  const StepRecord& r = record(3);
  const std::set<double> different = {r.coverage, r.coverage_visible, r.coverage_paper};
  EXPECT_EQ(different.size(), 3u) << "columns that could be taken for each other";
}

TEST_F(ScanFiles, ScoresHaveEachCandidateOfEachStep) {
  scan(housing());
  const CsvTable scores = table("scores.csv");
  ASSERT_EQ(scores.size(), 40u);
  for (std::size_t row = 0; row < 40; ++row) {
    const StepRecord& r = record(row / 10);
    const Candidate& c = r.candidates[row % 10];
    EXPECT_EQ(scores.number(row, "step"), double(r.step));
    EXPECT_EQ(scores.number(row, "view"), double(row % 10));
    EXPECT_EQ(scores.number(row, "available"), c.available ? 1.0 : 0.0);
    EXPECT_EQ(scores.number(row, "gain[cm²]"), c.gain);
    EXPECT_EQ(scores.number(row, "utility"), c.utility);
    const double way = (session->candidates()[row % 10].translation() - r.T_world_camera.translation()).norm();
    EXPECT_NEAR(scores.number(row, "cost[m]"), way, 1e-12) << "from where the camera stands";
  }
}

/// Files with the gain changed to one of another unit in the middle of the scan.
TEST_F(ScanFiles, EachRowSaysTheUnitOfItsGainWhereTheyDiffer) {
  session = std::make_unique<Session>(small_scan());
  session->step();
  session->step();
  PlanningConfig entropy = session->planning();
  entropy.planner.gain = "average-entropy";
  session->set_planning(entropy);
  session->step();
  OutputFolder out = begun(folder_);
  write_scan(*session, out);
  const CsvTable steps = table("steps.csv"), scores = table("scores.csv");
  EXPECT_EQ(steps.text(0, "gain_unit"), "");
  EXPECT_EQ(steps.text(1, "gain_unit"), "cm²");
  EXPECT_EQ(steps.text(2, "gain_unit"), "nats/voxel");
  EXPECT_EQ(steps.number(1, "gain"), record(1).gain);
  EXPECT_EQ(scores.text(0, "gain_unit"), "cm²");
  EXPECT_EQ(scores.text(10, "gain_unit"), "nats/voxel") << "ranked anew";
  EXPECT_EQ(scores.number(10, "gain"), record(1).candidates[0].gain);
}

TEST_F(ScanFiles, ViewsAreThePosesThatWereTaken) {
  scan(housing());
  const CsvTable views = table("views.csv");
  ASSERT_EQ(views.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto n = [&](const char* column) { return views.number(i, column); };
    const Eigen::Quaterniond q(n("qw"), n("qx"), n("qy"), n("qz"));
    EXPECT_NEAR(q.norm(), 1.0, 1e-12);
    EXPECT_LT((Vector3(n("x[m]"), n("y[m]"), n("z[m]")) - record(i).T_world_camera.translation()).norm(), 1e-12);
    EXPECT_LT((q.toRotationMatrix() - record(i).T_world_camera.linear()).norm(), 1e-12);
    EXPECT_EQ(n("view"), double(record(i).view));
    EXPECT_EQ(n("step"), double(i + 1));
  }
}

TEST_F(ScanFiles, TimingsAreOfTheirStages) {
  scan(housing());
  const CsvTable timings = table("timings.csv");
  for (std::size_t i = 0; i < 4; ++i) {
    const StageSeconds& s = record(i).seconds;
    for (const auto& [column, seconds] : std::vector<std::pair<std::string, double>>{{"sense[s]", s.sense},
                                                                                     {"clean[s]", s.clean},
                                                                                     {"insert[s]", s.insert},
                                                                                     {"refine[s]", s.refine},
                                                                                     {"score[s]", s.score},
                                                                                     {"evaluate[s]", s.evaluate}})
      EXPECT_NEAR(timings.number(i, column), seconds, 1e-6) << column;
  }
}

TEST_F(ScanFiles, MetricsAreOfTheWholeScan) {
  scan(housing());
  const auto json = metrics();
  const StepRecord& last = record(3);
  EXPECT_EQ(json["object"], "slotted_housing.ply");
  EXPECT_EQ(json["gain"], session->configuration().planner.gain);
  EXPECT_EQ(json["views"], 4);
  EXPECT_EQ(json["finished"], session->finished());
  EXPECT_EQ(json["entropy_bits"], last.entropy);
  EXPECT_EQ(json["total_entropy_bits"], last.total_entropy);
  EXPECT_EQ(json["coverage"]["d_reg_m"], 0.02);
  EXPECT_EQ(json["coverage"]["of_all_surface"], last.coverage);
  EXPECT_EQ(json["coverage"]["of_visible_surface"], last.coverage_visible);
  EXPECT_EQ(json["coverage"]["of_all_surface_at_0.5_mm"], last.coverage_paper);
  std::vector<double> distances;  // every point of every view
  const MeshDistance surface(*session->mesh());
  for (const auto& scan : session->scans())
    for (const Eigen::Vector3f& p : scan->hits) distances.push_back(surface(p));
  std::sort(distances.begin(), distances.end());
  double sum = 0.0, squares = 0.0;
  for (const double d : distances) sum += d, squares += d * d;
  const double n = double(distances.size());
  EXPECT_EQ(json["accuracy_m"]["points"], distances.size());
  EXPECT_NEAR(json["accuracy_m"]["mean"], sum / n, 1e-12);
  EXPECT_NEAR(json["accuracy_m"]["rms"], std::sqrt(squares / n), 1e-12);
  EXPECT_EQ(json["accuracy_m"]["percentile_95"], distances[std::size_t(std::ceil(0.95 * n)) - 1]);
  EXPECT_EQ(read_ply(folder_ / "cloud.ply").size(), distances.size());
}

TEST_F(ScanFiles, MetricsScoreTheMapUnderTheNamesOfTruthAndSet) {
  scan(housing());
  const auto json = metrics()["map"];
  const auto p = probabilities(session->map().voxels());
  const GroundTruth& truth = session->known_object()->truth();
  std::set<double> different;
  for (const TruthConvention convention : {TruthConvention::touch, TruthConvention::centre}) {
    const std::string of = convention == TruthConvention::touch ? "touch truth" : "centre truth";
    for (const auto& [set, called] : {std::pair(ScoredSet::visited, "visited"),
                                      {ScoredSet::visited_band, "visited band"},
                                      {ScoredSet::region, "region"}}) {
      const MapQuality q = map_quality(p, truth, convention, set, session->evaluation()->visited_voxels.bytes());
      const auto& found = json[of][called];
      EXPECT_EQ(found["voxels"], q.voxels) << of << called;
      EXPECT_NEAR(found["log_loss_nats"].get<double>(), q.log_loss, 1e-12 * q.log_loss) << of << called;
      EXPECT_NEAR(found["brier"].get<double>(), q.brier, 1e-12 * q.brier) << of << called;
      EXPECT_NEAR(found["d_kl_nats"].get<double>(), q.divergence, 1e-12 * q.divergence) << of << called;
      EXPECT_NEAR(found["d_kl_outside_band"].get<double>(), q.divergence_outside_band,
                  1e-12 * q.divergence_outside_band)
          << of << called;
      EXPECT_NEAR(found["expected_calibration_error"].get<double>(), q.calibration_error, 1e-12 * q.calibration_error)
          << of << called;
      different.insert({q.log_loss, q.brier, q.divergence});
    }
    std::size_t occupied = 0, found = 0;  // of the visited voxels that the truth calls occupied
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (!session->evaluation()->visited_voxels[v] || voxel_truth(truth, v, convention) != VoxelTruth::occupied)
        continue;
      ++occupied;
      found += session->map().voxels()[v].measured && p[v] >= 0.5f;
    }
    EXPECT_EQ(json[of]["surface_recall"], double(found) / double(occupied)) << of;
  }
  EXPECT_EQ(different.size(), 18u);
}

TEST_F(ScanFiles, RefinementsHaveARowAStep) {
  Configuration c = housing();
  c.planner.gain = "gibbs";
  scan(c);
  const CsvTable rows = table("refinement.csv"), scores = table("scores.csv");
  ASSERT_EQ(rows.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const RefinementRecord& r = *record(i).refinement;
    const SamplerDiagnostics& d = r.diagnostics;
    for (const auto& [column, value] :
         std::vector<std::pair<std::string, double>>{{"step", double(i + 1)},
                                                     {"merged_rays", double(d.merged_rays)},
                                                     {"informed_voxels", double(d.informed_voxels)},
                                                     {"changed_class", double(r.changed_class)},
                                                     {"sweeps", double(d.sweeps)},
                                                     {"r_hat", d.r_hat},
                                                     {"trend_z", d.trend},
                                                     {"disagreeing_voxels", double(d.disagreeing_voxels)},
                                                     {"stationary", d.stationary ? 1.0 : 0.0},
                                                     {"conventional_next_view", double(r.conventional_best.value())},
                                                     {"rank_correlation", r.rank_correlation},
                                                     {"log_loss_near_surface[nats]", r.quality_near_surface.log_loss},
                                                     {"brier_near_surface", r.quality_near_surface.brier}})
      EXPECT_EQ(rows.number(i, column), value) << column << ", step " << i + 1;
    for (std::size_t v = 0; v < 10; ++v) {
      EXPECT_EQ(scores.number(10 * i + v, "gain_on_conventional_map[nats]"), r.conventional_gains[v]);
      EXPECT_EQ(scores.number(10 * i + v, "gain[nats]"), record(i).candidates[v].gain);
    }
  }
}

}  // namespace
}  // namespace nextview
