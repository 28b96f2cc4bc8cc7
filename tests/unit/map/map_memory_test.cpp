// A map that there is no memory for is refused before any of it is taken.
#include <gtest/gtest.h>

#include <string>

#include "core/map/occupancy_map.hpp"
#include "core/memory/available_memory.hpp"
#include "tests/unit/memory/in_child.hpp"

namespace nextview {
namespace {

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
constexpr std::uint64_t kept_for_the_rest = 48 * megabyte;  // no map may have it

/// The largest cube of voxels that takes no more than this.
VoxelGrid cube_of(std::uint64_t bytes) {
  VoxelGrid grid{0.01, {0, 0, 0}, {1, 1, 1}}, larger = grid;
  while (OccupancyMap::bytes(larger) <= bytes) grid = larger, larger.size += Eigen::Vector3i::Ones();
  return grid;
}

/// What keeps a map from being made where so much is left for maps; empty if nothing does.
std::string refusal(const VoxelGrid& grid, std::uint64_t left) {
  if (!leave(RLIMIT_AS, kept_for_the_rest + left)) return "no limit";
  try {
    const OccupancyMap map(grid);
    return map.voxels().size() == grid.voxel_count() ? "" : "another map";
  } catch (const OutOfMemory& error) {
    return error.what();
  }
}

TEST(MapMemory, ThatIsNotThereIsRefused) {
  if (!memory_can_be_limited) GTEST_SKIP() << "built with sanitizers";
  const VoxelGrid grid = cube_of(24 * megabyte);
  EXPECT_TRUE(holds_in_child([&] {
    const std::string why = refusal(grid, 20 * megabyte), side = std::to_string(grid.size.x());
    return why.starts_with("a map of " + side + " x " + side + " x " + side + " voxels needs 25 MB, ") &&
           why.ends_with(" are available: use coarser voxels or a smaller region");
  }));
}

TEST(MapMemory, ThatIsThereIsTaken) {
  if (!memory_can_be_limited) GTEST_SKIP() << "built with sanitizers";
  EXPECT_TRUE(holds_in_child([] { return refusal(cube_of(17 * megabyte), 20 * megabyte).empty(); }));
}

// A planner makes many maps of some megabytes; and before it is measured, such a map takes next to nothing.
TEST(MapMemory, OfASmallMapIsNotAskedFor) {
  if (!memory_can_be_limited) GTEST_SKIP() << "built with sanitizers";
  EXPECT_TRUE(holds_in_child([] { return refusal(cube_of(12 * megabyte), 4 * megabyte).empty(); }));
}

}  // namespace
}  // namespace nextview
