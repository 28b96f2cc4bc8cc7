// Looking ahead: the tree search against all sequences there are, drawn worlds against what rays expect, and a planner
// that does so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "core/calibration/slant_fit.hpp"
#include "core/planner/look_ahead_planner.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

DrawnWorld::Samples between(std::size_t begin, std::size_t end) {
  DrawnWorld::Samples samples;
  for (std::size_t i = begin; i < end; ++i) samples.set(i);
  return samples;
}

/// Views that are equally far from each other.
ViewTree tree_of(std::vector<DrawnWorld> worlds) {
  ViewTree tree;
  tree.worlds = std::move(worlds);
  const std::size_t views = tree.worlds[0].seen.size();
  for (std::size_t v = 0; v < views; ++v) {
    double sum = 0.0;
    for (const DrawnWorld& world : tree.worlds) sum += world.area * double(world.seen[v].count());
    tree.gains.push_back(sum / double(tree.worlds.size()));
  }
  tree.prices.assign(views + 1, std::vector<double>(views, 1.0));
  tree.ways = tree.prices;
  tree.ranked = std::size_t(std::ranges::max_element(tree.gains) - tree.gains.begin());
  return tree;
}

/// The most valuable sequence's value, of all that there are.
double best_of_all(const ViewTree& tree, std::vector<std::size_t> so_far = {}, double price = 0.0) {
  if (so_far.size() == tree.depth) return 0.0;
  double best = 0.0;
  for (std::size_t v = 0; v < tree.gains.size(); ++v) {
    if (std::ranges::count(so_far, v) > 0) continue;
    double area = 0.0;
    for (const DrawnWorld& world : tree.worlds) {
      DrawnWorld::Samples seen;
      for (const std::size_t u : so_far) seen |= world.seen[u];
      area += world.area * double(((seen | world.seen[v]).count() - seen.count())) / double(tree.worlds.size());
    }
    const double after = price + tree.prices[so_far.empty() ? tree.gains.size() : so_far.back()][v];
    std::vector<std::size_t> longer = so_far;
    longer.push_back(v);
    best = std::max(best, area * std::pow(tree.kept, after) + best_of_all(tree, longer, after));
  }
  return best;
}

TEST(LookAhead, TakesTheBetterPairWhereTheBestSingleViewIsATrap) {
  // The first sees most, the middle; with it, both of the others show less than half of what they have.
  const ViewTree tree = tree_of({{{between(50, 150), between(0, 95), between(105, 200)}, 1.0}});
  ASSERT_EQ(tree.ranked, 0u);
  const LookAhead found = look_ahead(tree, 200);
  EXPECT_NE(found.best.views.front(), 0u);
  EXPECT_EQ(found.best.views.back(), 0u);
  EXPECT_EQ(found.of_ranked.views.front(), 0u);
  EXPECT_GT(found.best.value, found.of_ranked.value);
  EXPECT_DOUBLE_EQ(found.best.area, 200.0);
  EXPECT_DOUBLE_EQ(found.best.way, 3.0);
}

/// Four of six views, in three worlds: 360 sequences.
ViewTree random_tree(std::mt19937& random) {
  std::vector<DrawnWorld> worlds(3);
  for (DrawnWorld& world : worlds) {
    world.area = 0.5 + double(random() % 100) / 100.0;
    for (int v = 0; v < 6; ++v) {
      const std::size_t begin = random() % 200;
      world.seen.push_back(between(begin, std::min<std::size_t>(256, begin + 20 + random() % 80)));
    }
  }
  ViewTree tree = tree_of(std::move(worlds));
  tree.depth = 4;
  for (auto& row : tree.prices)
    for (double& price : row) price = 0.5 + double(random() % 100) / 100.0;
  return tree;
}

TEST(LookAhead, FindsTheBestOfAllSequences) {
  std::mt19937 random(4);
  for (int problem = 0; problem < 5; ++problem) {
    const ViewTree tree = random_tree(random);
    EXPECT_NEAR(look_ahead(tree, 20000).best.value, best_of_all(tree), 1e-9);
  }
}

// Where it has found much it looks on: a third of the simulations that all sequences would take are enough.
TEST(LookAhead, FindsItWithoutTryingAll) {
  std::mt19937 random(4);
  for (int problem = 0; problem < 20; ++problem) {
    const ViewTree tree = random_tree(random);
    const LookAhead found = look_ahead(tree, 120);
    EXPECT_NEAR(found.best.value, best_of_all(tree), 1e-9) << problem;
    EXPECT_EQ(found.of_ranked.views.front(), tree.ranked) << problem;
    EXPECT_LE(found.of_ranked.value, found.best.value) << problem;
    EXPECT_EQ(std::set(found.best.views.begin(), found.best.views.end()).size(), 4u) << "no view twice";
  }
}

TEST(LookAhead, ObeysAStop) {
  std::stop_source stop;
  stop.request_stop();
  const ViewTree tree = tree_of({{{between(0, 10), between(5, 30)}, 1.0}});
  EXPECT_THROW(look_ahead(tree, 100, stop.get_token()), Stopped);
}

const PinholeCamera camera = PinholeCamera::from_field_of_view(80, 60, 1.0);

/// Where a ray meets the box of edge 0.4 m around the origin [m]; negative: nowhere.
double to_box(const Vector3& origin, const Vector3& direction) {
  double enter = 0.0, leave = 10.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-0.2 - origin[axis]) / direction[axis], b = (0.2 - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : -1.0;
}

Scan scan_of_box(const Pose& view) {
  Scan scan;
  scan.origin = view.translation();
  scan.max_range = 1.5;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Vector3 direction = view.linear() * camera.direction(u, v);
      const double range = to_box(scan.origin, direction);
      auto& points = range > 0.0 ? scan.hits : scan.misses;
      points.push_back((scan.origin + (range > 0.0 ? range : 1.5) * direction).cast<float>());
    }
  return scan;
}

/// A ring of views around the box, the first of them taken.
struct SeenBox {
  SeenBox() {
    for (int i = 0; i < 12; ++i) {
      const double turn = i * std::numbers::pi / 6;
      views.push_back({look_at({0.9 * std::cos(turn), 0.9 * std::sin(turn), 0.4}, Vector3::Zero())});
    }
    fuse(known, scan_of_box(views[0].T_world_camera), {Insertion::direct, default_occlusion_distance});
    known.taken.push_back({views[0], views[0].T_world_camera});
    for (const View& view : views)
      candidates.push_back(
          {view != views[0], 0.0, (view.T_world_camera.translation() - views[0].T_world_camera.translation()).norm()});
  }
  Plan plan(int simulations, std::stop_token stop = {}) const {
    PlannerConfig config;
    config.simulations = simulations;
    return make_planner(config)->plan({config, 1, 60.0, 4.0, bundle, nullptr}, known, views, candidates, stop);
  }

  Knowledge known{OccupancyMap(region_of_interest(Vector3::Zero(), 1.28, 0.02))};
  std::vector<View> views;
  std::vector<Candidate> candidates;
  RayBundle bundle = RayBundle::regular(camera, 19, 13);
};

TEST(DrawnWorlds, ShowViewsAboutWhatRaysExpect) {
  const SeenBox box;
  const SurfaceEvidence evidence = surface_evidence(box.known);
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  const NewSurfaceField field(evidence, model);
  const std::vector<Pose> poses = poses_of(box.views);
  const SurfaceSlant of_all_views = model.slant.times(1.0 / SlantFit::views_taken_show);
  const auto expected = expected_new_surface(field, poses, box.bundle, {1.5, of_all_views});
  WorldDraws draws;
  draws.count = 100;
  const auto worlds = draw_worlds(evidence, field, poses, box.bundle, draws);
  std::vector<double> drawn(poses.size(), 0.0);
  for (const DrawnWorld& world : worlds)
    for (std::size_t v = 0; v < poses.size(); ++v)
      drawn[v] += world.area * double(world.seen[v].count()) / double(worlds.size());
  // The first view was taken.
  for (std::size_t v = 1; v < poses.size(); ++v) EXPECT_NEAR(drawn[v] / expected[v], 1.05, 0.15) << "view " << v;
}

TEST(LookAheadPlanner, WithoutSimulationsIsTheGreedyPlan) {
  const SeenBox box;
  const OneStepPlanner greedy(std::make_unique<NewSurfacePolicy>(NewSurfaceModel::fitted()));
  const PlannerConfig config;
  const Plan expected =
      greedy.plan({config, 1, 60.0, 4.0, box.bundle, nullptr}, box.known, box.views, box.candidates, {});
  const Plan plan = box.plan(0);
  EXPECT_EQ(plan.ranking.best, expected.ranking.best);
  EXPECT_EQ(plan.ranking.reason, expected.ranking.reason);
  for (std::size_t v = 0; v < plan.candidates.size(); ++v)
    EXPECT_EQ(plan.candidates[v].utility, expected.candidates[v].utility);
}

TEST(LookAheadPlanner, IsTheSameOnAnyNumberOfThreads) {
  const SeenBox box;
  const auto limited = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return box.plan(100);
  };
  const Plan one = limited(1), two = limited(2);
  EXPECT_EQ(one.ranking.best, two.ranking.best);
  EXPECT_EQ(one.ranking.reason, two.ranking.reason);
}

TEST(LookAheadPlanner, ObeysAStop) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(SeenBox().plan(100, stop.get_token()), Stopped);
}

TEST(LookAheadPlanner, OnlyLooksAheadForNewSurface) {
  PlannerConfig config;
  config.simulations = 10;
  config.validate();
  config.gain = "occlusion-aware";
  try {
    config.validate();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("planner.simulations"));
  }
}

}  // namespace
}  // namespace nextview
