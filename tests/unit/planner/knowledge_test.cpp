// A scan enters all that is known: the map, the Gibbs map, and what lies behind surfaces.
#include "core/planner/knowledge.hpp"

#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// Voxels of 10 cm in a row of eight, three wide and high, that a camera looks along.
constexpr double edge = 0.1;
VoxelGrid row() { return {edge, {0, 0, 0}, {8, 3, 3}}; }

/// So many returns from the middle of the fifth voxel of the middle row.
Scan returns(int count) {
  Scan scan;
  scan.origin = {-0.35, 0.15, 0.15};
  scan.hits.assign(static_cast<std::size_t>(count), Eigen::Vector3f(0.45f, 0.15f, 0.15f));
  scan.max_range = 1.5;
  return scan;
}

Knowledge with_posterior() {
  Knowledge known{OccupancyMap(row())};
  known.posterior = std::make_shared<GibbsState>(row(), PosteriorSamplerConfig(), InverseSensorModel());
  return known;
}

Voxel along(const VoxelBricks& voxels, int x) { return voxels[row().index({x, 1, 1})]; }

/// That the posterior is of, merged or not.
std::size_t rays_of(const Knowledge& known) {
  std::size_t rays = 0;
  for (const RangeMeasurement& ray : known.posterior->measurements().rays) rays += ray.weight;
  return rays;
}

TEST(Fuse, AScanEntersTheMap) {
  Knowledge known{OccupancyMap(row())};
  const FusionSeconds seconds = fuse(known, returns(1), {});
  EXPECT_GT(along(known.map.voxels(), 4).probability, 0.5f);
  EXPECT_LT(along(known.map.voxels(), 2).probability, 0.5f);
  EXPECT_FALSE(along(known.map.voxels(), 6).measured);
  EXPECT_FALSE(known.posterior);
  EXPECT_GT(seconds.insert, 0.0);
  EXPECT_EQ(seconds.refine, 0.0) << "there was nothing to refine";
}

TEST(Fuse, MarksWhatLiesBehindSurfacesIfAskedTo) {
  for (const double distance : {0.0, 0.25}) {
    Knowledge known{OccupancyMap(row())};
    fuse(known, returns(1), {Insertion::direct, distance});
    EXPECT_EQ(along(known.map.voxels(), 5).occlusion_distance, distance > 0.0 ? 1 : 0);
    EXPECT_EQ(along(known.map.voxels(), 3).occlusion_distance, 0);
  }
}

TEST(Fuse, EachScanEntersThePosteriorToo) {
  Knowledge known = with_posterior();
  const FusionSeconds seconds = fuse(known, returns(20), {Insertion::direct, 0.0, 20});
  EXPECT_GT(seconds.refine, 0.0);
  EXPECT_EQ(rays_of(known), 20u);
  EXPECT_GT(along(known.planning_voxels(), 4).probability, 0.5f);
  EXPECT_LT(along(known.planning_voxels(), 2).probability, 0.5f);
  EXPECT_FALSE(along(known.planning_voxels(), 7).measured) << "nothing reached it";
  const Knowledge before = known;
  fuse(known, returns(5), {Insertion::direct, 0.0, 20});
  EXPECT_EQ(rays_of(known), 25u);
  EXPECT_EQ(rays_of(before), 20u) << "what was copied stays as it was";
}

TEST(Fuse, ViewsArePlannedOnThePosteriorIfThereIsOne) {
  const Knowledge with = with_posterior(), without{OccupancyMap(row())};
  EXPECT_EQ(&with.planning_voxels(), &with.posterior->voxels());
  EXPECT_EQ(&without.planning_voxels(), &without.map.voxels());
}

TEST(Fuse, StoppedLeavesAllAsItWas) {
  std::stop_source stop;
  Knowledge known = with_posterior();
  const Progress stops = [&](double, std::string_view) { stop.request_stop(); };
  EXPECT_THROW(fuse(known, returns(20), {Insertion::direct, 0.0, 20}, stops, stop.get_token()), Stopped);
  EXPECT_EQ(rays_of(known), 0u);
  EXPECT_FALSE(along(known.map.voxels(), 4).measured);
  EXPECT_THROW(fuse(known, returns(1), {}, {}, stop.get_token()), Stopped) << "it was stopped before";
  EXPECT_FALSE(along(known.map.voxels(), 4).measured);
}

TEST(Knowledge, KnowsWhichViewsWereTaken) {
  const View a{Pose::Identity(), 3u}, b{Pose(Eigen::Translation3d(0, 0, 1))}, c{Pose::Identity(), 5u};
  Knowledge known;
  known.taken = {{a, a.T_world_camera}, {b, b.T_world_camera}};
  EXPECT_EQ(known.taken_as(a), 0u);
  EXPECT_EQ(known.taken_as(b), 1u);
  EXPECT_EQ(known.taken_as(c), std::nullopt);
  EXPECT_TRUE(known.has_taken(b) && !known.has_taken(c));
  known.taken.push_back({c, c.T_world_camera});
  EXPECT_EQ(frames_taken(known), (std::vector<std::size_t>{3, 5})) << "views of no frame are passed over";
}

}  // namespace
}  // namespace nextview
