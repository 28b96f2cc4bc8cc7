// Ways behind returns in lanes against the walk of one at a time, on each instruction set that this processor has.
#include "core/map/occlusion_marks.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>

#include "core/map/traversal.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/map/instruction_sets.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double any_range = std::numeric_limits<double>::infinity();

using Numbers = std::vector<std::uint16_t>;

/// The numbers of the grid's voxels, made by the plain walk.
Numbers walked_behind(const VoxelGrid& grid, const Eigen::Vector3f& origin, const PointCloud& returns, double max_range,
                      double distance) {
  Numbers numbers(grid.voxel_count());
  for (const Eigen::Vector3f& at : returns) {
    const double range = ray_length(origin, at);
    if (!(range > 0.0 && range <= max_range) || !grid.contains(grid.cell_at(at.cast<double>()))) continue;
    int behind = -1;
    walk_segment(grid, at, point_on_ray(origin, at, range + distance), [&](int x, int y, int z) {
      if (!grid.contains({x, y, z})) return false;
      if (++behind == 0) return true;
      std::uint16_t& number = numbers[grid.index({x, y, z})];
      number = static_cast<std::uint16_t>(number == 0 ? behind : std::min<int>(number, behind));
      return true;
    });
  }
  return numbers;
}

Numbers marked_behind(const VoxelGrid& grid, const Eigen::Vector3f& origin, const PointCloud& returns, double max_range,
                      double distance) {
  OcclusionMarks marks(grid);
  marks.mark(origin, returns, max_range, distance);
  Numbers all;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) all.push_back(*marks.row(grid.cell(v)));
  return all;
}

class OcclusionMarksOn : public OnInstructionSet {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, OcclusionMarksOn, instruction_sets(), instruction_set_name);

TEST_P(OcclusionMarksOn, AreThoseOfThePlainWalk) {
  std::mt19937 random(11);
  std::size_t all = 0;
  for (const double resolution : {0.01, 0.013, 0.05})
    for (const Vector3& origin : random_scans::origins()) {
      const VoxelGrid grid = region_of_interest(Vector3(0.02, -0.01, 0.0), 0.6, resolution);
      const Scan scan = random_scans::scan(random, origin, resolution, 2003);
      const Eigen::Vector3f from = origin.cast<float>();
      for (const double max_range : {0.4, any_range})
        for (const double distance : {0.0101, 0.3, 5.0}) {
          const Numbers expected = walked_behind(grid, from, scan.hits, max_range, distance);
          EXPECT_EQ(marked_behind(grid, from, scan.hits, max_range, distance), expected) << origin.transpose();
          all += expected.size() - static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 0));
        }
    }
  EXPECT_GT(all, 100'000u);
}

TEST_P(OcclusionMarksOn, OfABoxThatIsNoCubeAndAnyNumberOfReturns) {
  std::mt19937 random(12);
  const VoxelGrid grid = region_of_interest({Vector3(-0.31, 0.02, -0.1), Vector3(0.3, 0.11, 0.27)}, 0.01);
  const Eigen::Vector3f from(0.7f, -0.4f, 0.31f);
  PointCloud returns;
  for (int count = 0; count < 40; ++count) {
    EXPECT_EQ(marked_behind(grid, from, returns, any_range, 0.4), walked_behind(grid, from, returns, any_range, 0.4))
        << count;
    returns.push_back((random_scans::point_in_box(random, 0.3) + Vector3(0, 0.05, 0.1)).cast<float>());
  }
}

// Along the lattice, on its faces, out of the grid's sides, and returns that are none.
TEST_P(OcclusionMarksOn, OfWildReturns) {
  constexpr float infinity = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.64, 0.02);
  for (const Eigen::Vector3f& from : {Eigen::Vector3f(-1, 0, 0), Eigen::Vector3f(-0.3f, 0.01f, 0.01f),
                                      Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1e4f, 3e3f, 5)}) {
    PointCloud returns = {
        from,          {none, 0, 0},   {0, infinity, 0},      {1e38f, 1e38f, 0},     {0, 1e-30f, 0},    {0, 0, -1e-42f},
        {-1e6f, 0, 0}, {0.319f, 0, 0}, {0.01f, 0.01f, 0.01f}, {0.02f, 0.02f, 0.02f}, {0.3f, 0.3f, 0.3f}};
    for (const float step : {-0.32f, -0.02f, 0.0f, 0.02f, 0.0199f, 0.3199f})
      for (int axis = 0; axis < 3; ++axis) returns.push_back(step * Eigen::Vector3f::Unit(axis));
    for (const double distance : {1e-6, 0.02, 0.5, 100.0})
      EXPECT_EQ(marked_behind(grid, from, returns, any_range, distance),
                walked_behind(grid, from, returns, any_range, distance))
          << from.transpose() << ", " << distance;
  }
}

TEST(OcclusionMarks, TheRegionBehindHoldsAllThatIsMarked) {
  std::mt19937 random(14);
  bool smaller = false;
  for (const double resolution : {0.01, 0.013})
    for (const Vector3& origin : random_scans::origins())
      for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{40}}) {
        const VoxelGrid grid = region_of_interest(Vector3(0.02, -0.01, 0.0), 0.6, resolution);
        const Scan scan = random_scans::scan(random, origin, resolution, count);
        const VoxelGrid region = region_behind(grid, scan, 0.15);
        const Eigen::Vector3i first = region.first - grid.first;
        EXPECT_EQ(Eigen::Vector3i(first - first / 8 * 8), Eigen::Vector3i::Zero().eval()) << "whole bricks";
        OcclusionMarks in_region(region);
        in_region.mark(origin.cast<float>(), scan.hits, any_range, 0.15);
        const Numbers all = marked_behind(grid, origin.cast<float>(), scan.hits, any_range, 0.15);
        for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
          const Eigen::Vector3i cell = grid.cell(v) - first;
          ASSERT_EQ(region.contains(cell) ? *in_region.row(cell) : 0, all[v]);
        }
        smaller |= region.voxel_count() < grid.voxel_count() / 2;
      }
  EXPECT_TRUE(smaller);
}

TEST(OcclusionMarks, AreTheSameFromAnyNumberOfThreadsAndEndWhenAsked) {
  std::mt19937 random(13);
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.6, 0.01);
  const Eigen::Vector3f from(0.9f, 0.2f, -0.3f);
  const Scan scan = random_scans::scan(random, from.cast<double>(), 0.01, 20000);
  const Numbers expected = walked_behind(grid, from, scan.hits, any_range, 0.3);
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(marked_behind(grid, from, scan.hits, any_range, 0.3), expected) << threads;
  }
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(OcclusionMarks(grid).mark(from, scan.hits, any_range, 0.3, stop.get_token()), Stopped);
}

}  // namespace
}  // namespace nextview
