#include "core/planner/adaptive_candidates.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using evidence_maps::MadeMap;

const std::vector<View> fixed = {{look_at(Vector3(0.9, 0, 0), Vector3::Zero())},
                                 {look_at(Vector3(0, 0.9, 0), Vector3::Zero())},
                                 {look_at(Vector3(0, 0, 0.9), Vector3::Zero())}};

/// The side of a box that one view shows, 20 cm wide, in a region of 1 m whose middle is `shift` voxels aside.
Knowledge one_side(const Vector3i& shift = Vector3i::Zero()) {
  MadeMap made(VoxelGrid{0.02, Vector3i::Constant(-25) + shift, Vector3i::Constant(50)});
  made.set_box({0, 18, 18}, {19, 32, 32}, -1.5);
  made.set_box({20, 20, 20}, {20, 29, 29}, 1.5);
  return {made.map};
}

AdaptiveCandidatesConfig config(int kept = 16) {
  AdaptiveCandidatesConfig config;
  config.kept = kept;
  return config;
}

std::vector<View> candidates(const Knowledge& known, const AdaptiveCandidatesConfig& c = config()) {
  const RayBundle few = RayBundle::regular(PinholeCamera::from_field_of_view(80, 60, 1.0), 10, 7);
  return AdaptiveCandidates(fixed, few, c).candidates(known);
}

std::vector<Pose> made_for(const Knowledge& known, const AdaptiveCandidatesConfig& c = config()) {
  const std::vector<View> all = candidates(known, c);
  return poses_of(std::span(all).subspan(fixed.size()));
}

void expect_fixed_first(const std::vector<View>& views) {
  ASSERT_GE(views.size(), fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) EXPECT_EQ(views[i], fixed[i]);
}

TEST(AdaptiveCandidates, NothingKnownLeavesTheFixedOnes) {
  MadeMap free({30, 30, 30});
  free.set_box({5, 5, 5}, {20, 20, 20}, -1.0);
  for (const Knowledge& known : {Knowledge{}, Knowledge{MadeMap({30, 30, 30}).map}, Knowledge{free.map}})
    EXPECT_EQ(candidates(known), fixed);
}

TEST(AdaptiveCandidates, FixedOnesComeFirstAndAtMostSoManyFollow) {
  const Knowledge known = one_side();
  for (const int kept : {0, 1, 5, 16, 300}) {
    const std::vector<View> views = candidates(known, config(kept));
    expect_fixed_first(views);
    EXPECT_LE(views.size(), fixed.size() + std::size_t(kept));
    EXPECT_GE(views.size(), fixed.size() + std::size_t(std::min(kept, 16))) << "there is enough to see";
    for (const View& view : views) EXPECT_TRUE(is_pose(view.T_world_camera));
  }
}

TEST(AdaptiveCandidates, MoreOfThemBeginWithTheSame) {
  const Knowledge known = one_side();
  const auto few = candidates(known, config(5)), many = candidates(known, config(16));
  ASSERT_GE(many.size(), few.size());
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]) << "the best come first";
}

TEST(AdaptiveCandidates, KeepTheirDistanceAndAreNotAlike) {
  const Knowledge known = one_side();
  const SurfaceEvidence evidence(known.map.grid(), known.map.voxels(), known.map.voxels(), 0.5);
  const double size = evidence.object().diagonal().norm();
  for (const double distance : {0.9, 0.25}) {  // from the nearer one many views would be too near
    AdaptiveCandidatesConfig c = config(100);
    c.distance = distance;
    const auto made = made_for(known, c);
    ASSERT_GT(made.size(), 5u);
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_GT(evidence.object().exteriorDistance(made[i].translation()), 0.15 * size);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE((made[i].translation() - made[k].translation()).norm() < 0.2 * distance &&
                     made[i].linear().col(2).dot(made[k].linear().col(2)) > 0.97)
            << i << " and " << k;
    }
  }
}

TEST(AdaptiveCandidates, LookAtTheObjectFromAboutTheDistance) {
  const std::vector<Pose> made = made_for(one_side());
  ASSERT_EQ(made.size(), 16u);
  for (const Pose& pose : made) {
    const double distance = pose.translation().norm();  // the object is about the middle of the region
    EXPECT_GT(distance, 0.25);
    EXPECT_LT(distance, 1.2);
    EXPECT_GT(pose.linear().col(2).dot(-pose.translation() / distance), 0.9);
  }
}

TEST(AdaptiveCandidates, AreNoNearerThanTheCameraSees) {
  const Knowledge known = one_side();
  const SurfaceEvidence evidence(known.map.grid(), known.map.voxels(), known.map.voxels(), 0.5);
  const auto nearest_of = [&](double min_range) {
    AdaptiveCandidatesConfig c = config(100);
    c.min_range = min_range;
    double nearest = 2.0;
    for (const Pose& pose : made_for(known, c))
      nearest = std::min(nearest, evidence.object().exteriorDistance(pose.translation()));
    return nearest;
  };
  EXPECT_LT(nearest_of(0.1), 0.5);
  EXPECT_GT(nearest_of(0.6), 0.6);
}

TEST(AdaptiveCandidates, ShowNewSurfaceTheMostFirstButForEveryThird) {
  const Knowledge known = one_side();
  const SurfaceEvidence evidence(known.map.grid(), known.map.voxels(), known.map.voxels(), 0.5);
  const RayBundle few = RayBundle::regular(PinholeCamera::from_field_of_view(80, 60, 1.0), 10, 7);
  const auto c = config();
  const auto areas = expected_new_surface({evidence, c.model}, made_for(known), few, {c.ray_length, c.model.slant});
  double least = areas.at(0);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    EXPECT_GT(areas[i], 0.0);
    if (i % 3 == 2) continue;  // adds most to those before it
    EXPECT_LE(areas[i], least) << i;
    least = areas[i];
  }
}

TEST(AdaptiveCandidates, NoneIsMadeWhereNothingNewIsExpected) {
  AdaptiveCandidatesConfig c = config();
  c.ray_length = 0.01;  // no ray reaches the object
  EXPECT_EQ(candidates(one_side(), c), fixed);
}

TEST(AdaptiveCandidates, OfAnotherStepOrSeedAreOthers) {
  Knowledge known = one_side();
  const auto first = made_for(known);
  EXPECT_EQ(candidates(known), candidates(known));
  const auto differ = [&](const std::vector<Pose>& others) {
    for (const Pose& a : others)
      for (const Pose& b : first) EXPECT_NE(a.matrix(), b.matrix());
  };
  AdaptiveCandidatesConfig other_seed = config();
  other_seed.seed = 2;
  differ(made_for(known, other_seed));
  known.taken.push_back({fixed[0], fixed[0].T_world_camera});
  differ(made_for(known));
}

TEST(AdaptiveCandidates, TheSameOnOneThreadAndTwo) {
  const Knowledge known = one_side();
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return candidates(known);
  };
  EXPECT_EQ(run(1), run(2));
}

// A source's region need not be around the world's origin.
TEST(AdaptiveCandidates, GoWhereTheRegionGoes) {
  const Vector3i shift(120, -45, 30);
  const auto here = made_for(one_side()), there = made_for(one_side(shift));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_LT((there[i].translation() - here[i].translation() - 0.02 * shift.cast<double>()).norm(), 1e-9) << i;
    EXPECT_LT((there[i].linear() - here[i].linear()).norm(), 1e-9) << i;
  }
}

}  // namespace
}  // namespace nextview
