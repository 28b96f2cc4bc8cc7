// The map of the reference semantics by itself: what its numbers bound. That all of it is that of the reference code,
// conformance_test.cpp shows.
#include <gtest/gtest.h>

#include "core/gain/map_rays.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// In the middle of a voxel of 1 cm.
const Vector3 origin(0.005, 0.005, 0.005);

ReferenceMap::Parameters unbounded() {
  ReferenceMap::Parameters parameters;
  parameters.use_bounding_box = false;
  return parameters;
}

Eigen::Vector3f along_x(double range) { return (origin + range * Vector3::UnitX()).cast<float>(); }

void insert(ReferenceMap& map, const Eigen::Vector3f& point) { map.insert(origin, {&point, 1}); }

/// What a ray from the origin along an axis visits.
std::vector<RayVoxel> cast(const ReferenceMap& map, const Vector3& along = Vector3::UnitX()) {
  std::vector<RayVoxel> visited(3);  // is overwritten
  map.cast(origin, along, visited);
  return visited;
}

TEST(ReferenceMap, BeginsWithWhatTheReferenceCodeDoes) {
  const ReferenceMap::Parameters parameters;
  EXPECT_EQ(parameters.resolution, 0.01);
  EXPECT_EQ(parameters.unknown_prior, 0.5);
  EXPECT_EQ(parameters.max_sensor_range, 1.5);
  EXPECT_EQ(parameters.occlusion_distance, 0.3);
  EXPECT_EQ(parameters.max_ray_depth, 1.5);
}

TEST(ReferenceMap, RaysThroughNothingEndAtTheirDepth) {
  ReferenceMap::Parameters parameters = unbounded();
  parameters.max_ray_depth = 0.4;
  parameters.unknown_prior = 0.3;
  const auto visited = cast(ReferenceMap(parameters));
  ASSERT_EQ(visited.size(), 41u) << "that of the origin, and one each centimetre";
  for (std::size_t i = 0; i < visited.size(); ++i) {
    EXPECT_EQ(visited[i].lattice, (std::array<std::int16_t, 3>{std::int16_t(i), 0, 0}));
    EXPECT_FALSE(visited[i].has_node || visited[i].measured);
    EXPECT_FLOAT_EQ(visited[i].probability, 0.3f);
    EXPECT_EQ(visited[i].voxel_class, VoxelClass::unknown);
  }
}

TEST(ReferenceMap, ARayEndsAtTheSurfaceAndWasFreeBefore) {
  ReferenceMap map(unbounded());
  insert(map, along_x(0.5));
  const auto visited = cast(map);
  ASSERT_EQ(visited.size(), 51u);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_TRUE(visited[i].measured) << i;
    EXPECT_FLOAT_EQ(visited[i].probability, 0.4f) << "a miss: " << i;
  }
  EXPECT_TRUE(visited[50].measured);
  EXPECT_FLOAT_EQ(visited[50].probability, 0.7f) << "a hit";
}

TEST(ReferenceMap, BehindASurfaceVoxelsKnowHowFar) {
  ReferenceMap::Parameters parameters = unbounded();
  parameters.occlusion_distance = 0.1;
  ReferenceMap map(parameters);
  insert(map, along_x(0.5));
  const Vector3 behind = origin + 0.7 * Vector3::UnitX();
  std::vector<RayVoxel> visited;
  map.cast(behind, -Vector3::UnitX(), visited);  // back to the surface
  ASSERT_EQ(visited.size(), 21u);
  for (const RayVoxel& voxel : visited) {
    const int steps = voxel.lattice[0] - 50;
    // The last voxel that the way behind a point leads into is not reached: rays' ends are not among their keys.
    EXPECT_EQ(voxel.occlusion_distance, steps < 10 ? steps : 0) << steps;
    EXPECT_EQ(voxel.has_node, steps < 10) << steps;
    EXPECT_EQ(voxel.measured, steps == 0) << steps;
  }
}

TEST(ReferenceMap, OfTwoSurfacesTheNearerOneCounts) {
  ReferenceMap map(unbounded());
  insert(map, along_x(0.5));
  const Eigen::Vector3f nearer = along_x(0.6);                 // to what lies behind both
  map.insert(origin + 0.55 * Vector3::UnitX(), {&nearer, 1});  // from between them
  std::vector<RayVoxel> visited;
  map.cast(origin + 0.7 * Vector3::UnitX(), -Vector3::UnitX(), visited);
  ASSERT_EQ(visited.size(), 11u) << "up to the surface behind";
  EXPECT_TRUE(visited.back().measured);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_FALSE(visited[i].measured) << i;
    EXPECT_EQ(visited[i].occlusion_distance, 10 - i);
  }
}

TEST(ReferenceMap, FartherThanItsRangeASensorSeesFreeSpaceOnly) {
  for (const double range : {1.5, 0.6}) {
    ReferenceMap::Parameters parameters = unbounded();
    EXPECT_EQ(parameters.max_sensor_range, 1.5);
    parameters.max_sensor_range = range;
    parameters.max_ray_depth = 3.0;
    ReferenceMap at_its_end(parameters), beyond(parameters);
    const int last = int(std::lround(100 * range));
    insert(at_its_end, along_x(range));
    EXPECT_EQ(cast(at_its_end).size(), std::size_t(last) + 1);
    EXPECT_TRUE(cast(at_its_end).back().measured);
    insert(beyond, along_x(range + 0.05));
    const auto visited = cast(beyond);
    ASSERT_EQ(visited.size(), 301u) << "nothing stops a ray";
    for (const RayVoxel& voxel : visited) EXPECT_EQ(voxel.measured, voxel.lattice[0] < last) << voxel.lattice[0];
  }
}

TEST(ReferenceMap, WithoutALimitSurfacesAreSeenFromAnywhere) {
  ReferenceMap::Parameters parameters = unbounded();
  parameters.max_sensor_range = -1.0;
  parameters.max_ray_depth = 10.0;
  ReferenceMap map(parameters);
  insert(map, along_x(7.0));
  EXPECT_EQ(cast(map).size(), 701u);
}

TEST(ReferenceMap, PointsOutsideOfItsBoxAreDropped) {
  ReferenceMap::Parameters parameters;
  parameters.lower = {-0.2, -0.3, -0.4};
  parameters.upper = {0.4, 0.3, 0.2};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const Vector3 along = (upper ? 1.0 : -1.0) * Vector3::Unit(axis);
      const double face = std::abs((upper ? parameters.upper : parameters.lower)[axis]);
      for (const double beside : {-0.02, 0.02}) {
        ReferenceMap map(parameters);
        const Eigen::Vector3f point = (origin + (face + beside) * along).cast<float>();
        map.insert(origin, {&point, 1});
        const auto visited = cast(map, along);
        EXPECT_EQ(visited.front().measured, beside < 0.0) << axis << upper;
        EXPECT_EQ(visited.back().measured, beside < 0.0) << axis << upper;
      }
    }
}

TEST(ReferenceMap, ACopyIsAMapOfItsOwn) {
  ReferenceMap map(unbounded());
  insert(map, along_x(0.5));
  const auto copy = map.copy();
  const auto same = cast(*copy);
  ASSERT_EQ(same.size(), 51u);
  EXPECT_FLOAT_EQ(same.back().probability, 0.7f);
  insert(*copy, along_x(0.3));
  EXPECT_EQ(cast(*copy).size(), 31u);
  EXPECT_EQ(cast(map).size(), 51u) << "it is as it was";
  insert(*copy, along_x(0.3));
  EXPECT_NEAR(cast(*copy).back().probability, probability(log_odds(0.4) + 2.0 * log_odds(0.7)), 1e-6)
      << "a miss and two hits of the same sensor model";
}

TEST(ReferenceMap, WhatHasNoSenseIsRefusedAndAStopEndsInserting) {
  ReferenceMap::Parameters wrong = unbounded();
  wrong.model.hit = 0.4;
  EXPECT_THROW(ReferenceMap{wrong}, std::invalid_argument);
  ReferenceMap map(unbounded());
  std::stop_source stop;
  stop.request_stop();
  const std::vector<Eigen::Vector3f> many(100, along_x(0.5));
  EXPECT_THROW(map.insert(origin, many, stop.get_token()), Stopped);
}

}  // namespace
}  // namespace nextview
