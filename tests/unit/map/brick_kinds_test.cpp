#include "core/map/brick_kinds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

void expect_as_voxel_by_voxel(const Brick& brick, double threshold) {
  BrickKinds kinds(threshold);
  kinds.read(brick);
  for (int row = 0; row < 64; ++row)
    for (int x = 0; x < 8; ++x) {
      const Eigen::Vector3i cell = BrickKinds::cell(row) + Eigen::Vector3i(x, 0, 0);
      const Voxel voxel = brick[std::size_t(cell.z() * 64 + cell.y() * 8 + cell.x())];
      const bool occupied = voxel.measured && double(voxel.probability) >= threshold;
      EXPECT_EQ(kinds.occupied[std::size_t(row)] >> x & 1, occupied) << voxel.log_odds << " at " << threshold;
      EXPECT_EQ(kinds.unmeasured[std::size_t(row)] >> x & 1, !voxel.measured);
    }
}

/// Of few log-odds, about 0 among them; some voxels are not measured, but lie behind a surface.
Brick mixed_brick(std::mt19937& random) {
  std::uniform_int_distribution<int> any(-6, 6);
  Brick brick;
  for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) {
    if (any(random) < 0)
      brick.set_occlusion_distance(i, std::uint16_t(any(random) + 6));
    else
      brick.set_measured(i, 0.2f * float(any(random)), VoxelClass::unknown);
  }
  return brick;
}

TEST(BrickKinds, AreThoseOfItsVoxels) {
  std::mt19937 random(5);
  for (const double threshold : {0.0, 0.1, 0.5, 1 / (1 + std::exp(-0.4)), 0.7, 1.0}) {
    expect_as_voxel_by_voxel(mixed_brick(random), threshold);
    expect_as_voxel_by_voxel(Brick(), threshold);
    Brick uniform;
    for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) uniform.set_measured(i, 0.4f, VoxelClass::unknown);
    expect_as_voxel_by_voxel(uniform, threshold);
  }
}

TEST(BrickKinds, AreAsToldWhereTheyDoNotFollowFromLogOdds) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> probability(0.0f, 1.0f);
  Brick brick = mixed_brick(random);
  for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) {
    Voxel voxel = brick[i];
    voxel.probability = probability(random);
    brick.set(i, voxel);
  }
  for (const double threshold : {0.3, 0.5, 0.9}) expect_as_voxel_by_voxel(brick, threshold);
}

}  // namespace
}  // namespace nextview
