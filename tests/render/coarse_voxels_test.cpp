#include "ui/layers/coarse_voxels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

using Corner = std::tuple<int, int, int>;

/// Edges that not as many faces run along one way as the other: none if the surface is closed.
int open_edges(const CoarseVoxels& voxels) {
  std::map<std::pair<Corner, Corner>, int> balance;
  for (const VoxelFace& face : voxels.faces) {
    const auto corners = face_corners(voxels.grid, face);
    std::array<Corner, 4> at;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3i place = (corners[i] / voxels.grid.resolution).array().round().matrix().cast<int>();
      at[i] = {place.x(), place.y(), place.z()};
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const Corner a = at[i], b = at[(i + 1) % 4];
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  int open = 0;
  for (const auto& [edge, sum] : balance) open += sum != 0;
  return open;
}

std::vector<Voxel> voxels_of(const VoxelGrid& grid, const std::function<bool(std::uint32_t)>& occupied) {
  std::vector<Voxel> voxels(grid.voxel_count());
  for (std::uint32_t i = 0; i < voxels.size(); ++i) {
    const float p = occupied(i) ? 0.9f : 0.1f;
    voxels[i] = {p, float(entropy(p)), InverseSensorModel{}.classify(p), true, 0};
  }
  return voxels;
}

TEST(CoarseVoxels, ABallIsAClosedBallOfAFourthOfTheFaces) {
  const VoxelGrid grid{0.1, {-21, -20, -19}, {41, 41, 40}};
  const auto voxels = voxels_of(grid, [&](std::uint32_t i) { return grid.centre(i).norm() < 1.7; });
  const auto faces = exposed_faces(grid, voxels, {});
  for (const int halvings : {1, 2}) {
    const CoarseVoxels coarse = coarse_voxels(grid, faces, halvings);
    const double edge = coarse.grid.resolution, share = std::pow(4.0, -halvings);
    EXPECT_DOUBLE_EQ(edge, 0.1 * (1 << halvings));
    EXPECT_EQ(open_edges(coarse), 0);
    EXPECT_NEAR(double(coarse.faces.size()), share * double(faces.size()), 0.3 * share * double(faces.size()));
    ASSERT_EQ(coarse.stand_for.size(), coarse.faces.size());
    for (std::size_t i = 0; i < coarse.faces.size(); ++i) {
      const VoxelFace& stands_for = faces[coarse.stand_for[i]];
      EXPECT_EQ(stands_for.side, coarse.faces[i].side);
      const Vector3 apart = grid.centre(stands_for.voxel) - coarse.grid.centre(coarse.faces[i].voxel);
      EXPECT_LT(apart.cwiseAbs().maxCoeff(), edge / 2) << "its voxel is not in this one";
    }
  }
}

TEST(CoarseVoxels, NoFaceIsThereTwiceOrBetweenTwo) {
  const VoxelGrid grid{0.1, {-3, 2, 5}, {17, 12, 9}};
  const auto voxels = voxels_of(grid, [](std::uint32_t i) { return CounterRandom(3, 906).uniform(i)[0] < 0.2; });
  const CoarseVoxels coarse = coarse_voxels(grid, exposed_faces(grid, voxels, {}), 1);
  std::set<std::pair<std::uint32_t, int>> all;
  std::set<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < voxels.size(); ++i)
    if (voxels[i].voxel_class == VoxelClass::occupied) {
      const Eigen::Vector3i cell = (grid.first + grid.cell(i)).unaryExpr([](int n) { return n >> 1; });
      shown.insert(coarse.grid.index(cell - coarse.grid.first));
    }
  for (const VoxelFace& face : coarse.faces) {
    EXPECT_TRUE(all.emplace(face.voxel, face.side).second);
    const Eigen::Vector3i next =
        coarse.grid.cell(face.voxel) + (face.side % 2 ? 1 : -1) * Eigen::Vector3i::Unit(face.side / 2);
    EXPECT_FALSE(coarse.grid.contains(next) && shown.contains(coarse.grid.index(next)));
  }
}

TEST(CoarseVoxels, OfNothingAreNone) { EXPECT_TRUE(coarse_voxels({0.1, {0, 0, 0}, {4, 4, 4}}, {}, 1).faces.empty()); }

}  // namespace
}  // namespace nextview
