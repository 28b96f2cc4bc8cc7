// A scan that is planned on the Gibbs map.
#include <gtest/gtest.h>

#include "core/evaluation/entropy.hpp"
#include "core/gain/new_surface.hpp"
#include "core/gain/view_score.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/planner/open_border.hpp"
#include "core/session/session.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

Configuration gibbs_scan() {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.termination.views = 3;
  return c;
}

TEST(GibbsSession, PlansOnThePosterior) {
  Session session(gibbs_scan());
  while (session.finished().empty()) session.step();
  const StepRecord& last = session.records().back();
  ASSERT_TRUE(last.refinement.has_value());
  const GibbsPosterior& posterior = session.refinement()->posterior();
  const VoxelBricks& voxels = session.planning_voxels();
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    ASSERT_EQ(voxels[v].probability, posterior.touch[v]);
    ASSERT_EQ(voxels[v].entropy, static_cast<float>(entropy(posterior.touch[v])));
    ASSERT_EQ(voxels[v].voxel_class, session.map().model().classify(posterior.touch[v]));
    ASSERT_EQ(voxels[v].measured, posterior.informed[v] != 0);
  }
  EXPECT_EQ(last.total_entropy, map_entropy(voxels).total);
  // Scored anew through rays of our own, the candidates come out as recorded.
  const Configuration& c = session.configuration();
  const MapRays rays(posterior.grid, voxels, c.map.model.occupancy_threshold, c.planner.ray_length);
  const RayBundle bundle = RayBundle::regular(session.camera(), c.planner.ray_columns, c.planner.ray_rows);
  const Gain* one = &gain("gibbs");
  const auto scores = score_views(rays, session.candidates(), bundle, {&one, 1});
  for (std::size_t v = 0; v < scores.size(); ++v)
    if (last.candidates[v].available) {
      EXPECT_EQ(last.candidates[v].gain, scores[v].gains.front());
    }
}

TEST(GibbsSession, AnotherGainOfThePosteriorDoesNotRefineItAgain) {
  Session session(gibbs_scan());
  for (int i = 0; i < 2; ++i) session.step();
  const auto posterior = session.state().known.posterior;
  PlannerConfig plain = session.configuration().planner, other = plain;
  plain.gain = "area-factor";
  other.gain = "new-surface-gibbs";  // wants occlusions marked
  session.set_planner(other);
  EXPECT_EQ(session.state().known.posterior, posterior);
  const ScanState kept = session.state();
  session.set_planner(plain);
  EXPECT_EQ(session.state().known.posterior, nullptr);
  session.set_planner(other);
  EXPECT_TRUE(same_map(session.map(), kept.known.map));
  EXPECT_EQ(session.refinement()->posterior().touch, posterior->posterior().touch);
  EXPECT_TRUE(same_candidates(session.records()[1].candidates, kept.records[1]->candidates));
}

TEST(GibbsSession, APlannerThatNeedsNoPosteriorIsComparedWithNothing) {
  Session session(gibbs_scan());
  session.step();
  const RefinementRecord of_gibbs = *session.records().front().refinement;
  EXPECT_FALSE(of_gibbs.conventional_gains.empty());
  const PlannerConfig gibbs = session.configuration().planner;
  PlannerConfig plain = gibbs;
  plain.gain = "area-factor";
  session.set_planner(plain);
  const RefinementRecord& refinement = *session.records().front().refinement;
  EXPECT_TRUE(refinement.conventional_gains.empty());
  EXPECT_FALSE(refinement.conventional_best.has_value());
  EXPECT_EQ(refinement.rank_correlation, 0.0);
  EXPECT_EQ(refinement.changed_class, of_gibbs.changed_class) << "the step's entropy is the Gibbs map's all the same";
  session.set_planner(gibbs);
  EXPECT_EQ(session.records().front().refinement->conventional_gains, of_gibbs.conventional_gains);
}

TEST(GibbsSession, OtherSettingsRefineTheSameScansAnew) {
  Session session(gibbs_scan());
  for (int i = 0; i < 2; ++i) session.step();
  PlanningConfig doubtful = session.planning();
  doubtful.gibbs.sampler.prior = 0.3;
  const auto posterior = session.state().known.posterior;
  session.set_planning(doubtful);
  ASSERT_EQ(session.records().size(), 2u);
  EXPECT_NE(session.refinement()->posterior().touch, posterior->posterior().touch);

  Configuration from_the_start = gibbs_scan();
  from_the_start.gibbs = doubtful.gibbs;
  Session other(from_the_start);
  other.step();
  other.override_next_view(std::size_t(session.records()[1].view));
  other.step();
  EXPECT_EQ(session.refinement()->posterior().touch, other.refinement()->posterior().touch);
  EXPECT_TRUE(same_candidates(session.records()[1].candidates, other.records()[1].candidates));
}

TEST(GibbsSession, SettingsOfAMapThatNoGainNeedsChangeNothing) {
  Session session(small_scan());
  for (int i = 0; i < 2; ++i) session.step();
  const ScanState before = session.state();
  PlanningConfig doubtful = session.planning();
  doubtful.gibbs.sampler.prior = 0.3;
  session.set_planning(doubtful);
  EXPECT_EQ(session.configuration().gibbs.sampler.prior, 0.3);
  EXPECT_EQ(session.refinement(), nullptr);
  EXPECT_TRUE(same_map(session.map(), before.known.map));
  EXPECT_TRUE(same_candidates(session.records()[1].candidates, before.records[1]->candidates));
  EXPECT_EQ(session.next_view().matrix(), before.next.view.T_world_camera.matrix());
}

TEST(GibbsSession, TheConventionalMapAndItsRankingAreKeptBeside) {
  Session session(gibbs_scan()), plain(small_scan());
  session.step();
  plain.step();
  EXPECT_TRUE(same_map_but_for_occlusions(session.map(), plain.map()));
  const RefinementRecord& refinement = *session.records().front().refinement;
  const Configuration& c = session.configuration();
  const MapRays rays(session.map().grid(), session.map().voxels(), c.map.model.occupancy_threshold,
                     c.planner.ray_length);
  const RayBundle bundle = RayBundle::regular(session.camera(), c.planner.ray_columns, c.planner.ray_rows);
  const Gain* one = &gain("gibbs");
  const auto scores = score_views(rays, session.candidates(), bundle, {&one, 1});
  for (std::size_t v = 0; v < scores.size(); ++v) EXPECT_EQ(refinement.conventional_gains[v], scores[v].gains.front());
  EXPECT_GT(refinement.changed_class, 0u);
  EXPECT_TRUE(refinement.conventional_best.has_value());
}

TEST(GibbsSession, NewSurfaceIsExpectedOfThePosterior) {
  Configuration c = gibbs_scan();
  c.planner.gain = "new-surface-gibbs";
  c.planner.ray_refinement = 1;
  Session session(c);
  session.step();
  const OccupancyMap& map = session.map();
  const NewSurfaceModel& model = c.planner.new_surface;
  const SurfaceEvidence evidence(map.grid(), session.planning_voxels(), map.voxels(), c.map.model.occupancy_threshold,
                                 open_border(session.state().known));
  const RayBundle bundle = RayBundle::regular(session.camera(), c.planner.ray_columns, c.planner.ray_rows);
  const std::vector<Pose>& views = session.candidates();
  const auto areas = expected_new_surface({evidence, model}, views, bundle, {c.planner.ray_length, model.slant});
  const StepRecord& record = session.records().front();
  const double stage = shown_over_expected(record.surface_left.value());
  const auto& conventional = record.refinement->conventional_gains;
  std::size_t differ = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_EQ(record.candidates[v].gain, stage * areas[v]);
    differ += areas[v] != conventional[v];
  }
  EXPECT_GT(differ, views.size() / 2);
}

// What the Gibbs gain expects of a view is in nats: it is no promise of so many cm².
TEST(GibbsSession, AViewOfAnotherGainPromisedNoNewSurface) {
  Session session(small_scan());
  session.step();
  session.step();
  const PlanningConfig by_surface = session.planning();
  PlanningConfig by_entropy = by_surface;
  by_entropy.planner.gain = "gibbs";
  session.set_planning(by_entropy);
  session.step();
  EXPECT_EQ(session.records().back().gain_unit, "nats");
  EXPECT_GT(session.records().back().gain, 100.0);
  const std::vector<TakenView>& taken = session.state().known.taken;
  EXPECT_EQ(taken[0].expected_new_surface, 0.0) << "the start view";
  EXPECT_EQ(taken[1].expected_new_surface, session.records()[1].gain);
  EXPECT_EQ(taken[2].expected_new_surface, 0.0);
  const double kept = promise_kept(std::span(taken).first(2));
  EXPECT_EQ(promise_kept(taken), kept);
  session.set_planning(by_surface);
  session.step();
  EXPECT_EQ(session.records().back().gain_unit, "cm²");
  EXPECT_GT(session.state().known.taken[3].expected_new_surface, 0.0);
}

TEST(GibbsSession, EntropyAddsUpFromStepToStep) {
  Session session(gibbs_scan());
  double before = static_cast<double>(session.map().voxels().size());  // a bit a voxel
  while (session.finished().empty()) {
    session.step();
    const StepRecord& r = session.records().back();
    EXPECT_NEAR(r.realised_gain, (before - r.total_entropy) * std::numbers::ln2, 1e-6 * before);  // Eq. 12
    before = r.total_entropy;
  }
}

TEST(GibbsSession, AWarmStartAndAColdStartAgree) {
  Configuration warm = gibbs_scan(), cold = gibbs_scan();
  warm.gibbs.view_sweeps = 400;
  Session session(warm);
  while (session.finished().empty()) session.step();
  // The same views at once, from nothing.
  GibbsState once(session.map().grid(), posterior_sampler_config(cold), cold.map.model);
  for (std::size_t k = 0; k < session.records().size(); ++k) {
    const DepthImage image = DepthCamera(cold.sensor)
                                 .sense(MeshRayCaster(*session.mesh()), session.records()[k].T_world_camera, cold.seed,
                                        static_cast<std::uint32_t>(k + 1));
    Scan scan = back_project(image, session.records()[k].T_world_camera, cold.sensor.max_range);
    scan.hits = clean(scan.hits, cold.cloud);
    once.add(scan);
  }
  once.refine({}, 400, {}, {});
  double sum = 0.0, worst = 0.0;
  std::size_t count = 0;
  const GibbsPosterior &a = session.refinement()->posterior(), &b = once.posterior();
  for (std::size_t v = 0; v < a.occupied.size(); ++v) {
    if (!a.informed[v] || !b.informed[v]) continue;
    const double difference = std::abs(double(a.occupied[v]) - b.occupied[v]);
    sum += difference;
    worst = std::max(worst, difference);
    ++count;
  }
  ASSERT_GT(count, 1000u);
  EXPECT_LT(sum / static_cast<double>(count), 0.002);
  EXPECT_LT(worst, 0.25) << "a voxel at 0.5 has a standard error of 0.04 or so at 100 effective samples";
}

}  // namespace
}  // namespace nextview
