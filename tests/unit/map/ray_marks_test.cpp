// Rays in lanes against the walk of one ray at a time, on each instruction set that this processor has.
#include "core/map/ray_marks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>

#include "core/map/traversal.hpp"
#include "tests/unit/map/instruction_sets.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The marks of the grid's voxels, made by the plain walk.
std::vector<std::uint8_t> walked(const VoxelGrid& grid, const Eigen::Vector3f& origin, const PointCloud& ends,
                                 double max_range) {
  std::vector<std::uint8_t> marks(grid.voxel_count());
  for (const Eigen::Vector3f& end : ends) {
    const bool short_enough = ray_length(origin, end) <= max_range;
    walk_segment_inside(grid, origin, short_enough ? end : point_on_ray(origin, end, max_range),
                        [&](int x, int y, int z) {
                          marks[grid.index({x, y, z})] = 1;
                          return true;
                        });
  }
  return marks;
}

std::vector<std::uint8_t> marked(const VoxelGrid& grid, const Eigen::Vector3f& origin, const PointCloud& ends,
                                 double max_range) {
  RayMarks marks(grid);
  marks.pass(origin, ends, max_range);
  std::vector<std::uint8_t> all(grid.voxel_count());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = marks.at(grid.cell(v));
  return all;
}

TEST(RayMarks, OfAGridThatHasNoRoomInTheCacheAreTheSame) {
  std::mt19937 random(9);
  const VoxelGrid grid{0.002, {-150, -130, -120}, {300, 260, 225}};
  for (const Vector3& origin : {Vector3(0.9, 0.1, 0.2), Vector3(0.01, 0.0, 0.02)}) {
    Scan scan = random_scans::scan(random, origin, grid.resolution, 2000);
    random_scans::add_passes(scan, random, 300);
    const Eigen::Vector3f from = origin.cast<float>();
    EXPECT_EQ(marked(grid, from, scan.hits, 1.5), walked(grid, from, scan.hits, 1.5)) << origin.transpose();
  }
}

class RayMarksOn : public OnInstructionSet {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, RayMarksOn, instruction_sets(), instruction_set_name);

TEST_P(RayMarksOn, AreThoseOfThePlainWalk) {
  std::mt19937 random(7);
  std::size_t all = 0;
  for (const double resolution : {0.01, 0.013, 0.05})
    for (const Vector3& origin : random_scans::origins()) {
      const VoxelGrid grid = region_of_interest(Vector3(0.02, -0.01, 0.0), 0.6, resolution);
      Scan scan = random_scans::scan(random, origin, resolution, 3001);
      random_scans::add_passes(scan, random, 503);
      const Eigen::Vector3f from = origin.cast<float>();
      for (const PointCloud* ends : {&scan.hits, &scan.misses})
        for (const double max_range : {0.4, 1.5, no_limit}) {
          const auto expected = walked(grid, from, *ends, max_range);
          EXPECT_EQ(marked(grid, from, *ends, max_range), expected) << origin.transpose() << ", " << max_range;
          all += static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 1));
        }
    }
  EXPECT_GT(all, 100'000u);
}

TEST_P(RayMarksOn, OfABoxThatIsNoCubeAndAnyNumberOfRays) {
  std::mt19937 random(8);
  const VoxelGrid grid = region_of_interest({Vector3(-0.31, 0.02, -0.1), Vector3(0.3, 0.11, 0.27)}, 0.01);
  const Eigen::Vector3f from(0.7f, -0.4f, 0.31f);
  PointCloud ends;
  for (int rays = 0; rays < 70; ++rays) {
    EXPECT_EQ(marked(grid, from, ends, no_limit), walked(grid, from, ends, no_limit)) << rays;
    ends.push_back(random_scans::point_in_box(random, 0.5).cast<float>());
  }
}

TEST_P(RayMarksOn, FromFarAwayAndOfWildEnds) {
  constexpr float infinity = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(9);
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.0, 0.02);
  for (const float away : {0.0f, 0.5f, 1.0f, 30.0f, 1000.0f}) {
    const Eigen::Vector3f from(away, 0.31f * away, 0.005f);
    PointCloud ends = {from,
                       {none, 0, 0},
                       {0, infinity, 0},
                       {1e38f, 1e38f, 0},
                       {-1e15f, 1e14f, 3},
                       {-1e6f, 0, 0},
                       {0, 1e-30f, 0},
                       {0, 0, -1e-42f},
                       {-away, -0.31f * away, 0.005f}};
    const int rays = away > 100.0f ? 3 : 40;  // the plain walk takes its time
    for (int i = 0; i < rays; ++i) ends.push_back(random_scans::point_in_box(random, 0.6).cast<float>());
    for (const float step : {-0.02f, 0.0f, 0.02f, 0.019f}) ends.push_back(from + Eigen::Vector3f(step, 0, 0));
    EXPECT_EQ(marked(grid, from, ends, no_limit), walked(grid, from, ends, no_limit)) << away;
    EXPECT_EQ(marked(grid, from, ends, 0.9 * away), walked(grid, from, ends, 0.9 * away)) << away;
  }
}

// Farther than the lanes go.
TEST(RayMarks, FromBeyondTheHorizon) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.0, 0.02);
  const Eigen::Vector3f from(30000, 9300, 0.005f);
  const PointCloud ends = {{0, 0, 0}, {-3000, -930, 0.005f}};
  const auto expected = walked(grid, from, ends, no_limit);
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 10);
  EXPECT_EQ(marked(grid, from, ends, no_limit), expected);
}

// Where a face is met at the same distance along two axes, the last rounding says which comes first.
TEST_P(RayMarksOn, AlongDiagonalsAndThroughEdges) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.64, 0.01);
  for (const Eigen::Vector3f& from : {Eigen::Vector3f(0.5f, 0.5f, 0.5f), Eigen::Vector3f(0.505f, 0.505f, 0.5f),
                                      Eigen::Vector3f(-0.4f, 0.3f, 0.0f), Eigen::Vector3f(0.0f, 0.0f, 0.0f)}) {
    PointCloud ends;
    for (int x = -4; x <= 4; ++x)
      for (int y = -4; y <= 4; ++y)
        for (int z = -4; z <= 4; ++z) ends.push_back(from + 0.16f * Eigen::Vector3f(float(x), float(y), float(z)));
    EXPECT_EQ(marked(grid, from, ends, no_limit), walked(grid, from, ends, no_limit)) << from.transpose();
  }
}

TEST(RayMarks, AreTheSameOnAnyNumberOfThreads) {
  std::mt19937 random(10);
  const Vector3 origin(0.9, 0.1, 0.2);
  const Scan scan = random_scans::scan(random, origin, 0.01, 20'000);
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  const auto expected = walked(grid, origin.cast<float>(), scan.hits, 1.5);
  for (const int threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(marked(grid, origin.cast<float>(), scan.hits, 1.5), expected) << threads;
  }
}

}  // namespace
}  // namespace nextview
