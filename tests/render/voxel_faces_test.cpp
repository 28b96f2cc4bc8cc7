#include "ui/layers/voxel_faces.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

struct RandomMap {
  VoxelGrid grid;
  std::vector<Voxel> voxels;

  RandomMap(const Eigen::Vector3i& size, std::uint64_t seed, double measured)
      : grid{0.1, {-3, 2, 5}, size}, voxels(grid.voxel_count()) {
    for (std::uint32_t i = 0; i < voxels.size(); ++i) {
      const auto draw = CounterRandom(seed, 904).uniform(i);
      const auto p = float(draw[1]);
      voxels[i] = {p, float(entropy(p)), InverseSensorModel{}.classify(p), draw[0] < measured, 0};
    }
  }
  bool shown(const Eigen::Vector3i& cell, const VoxelFilter& filter) const {
    return grid.contains(cell) && filter.shows(grid, grid.index(cell), voxels[grid.index(cell)]);
  }
};

std::vector<VoxelFilter> filters() {
  VoxelFilter uncertain, slice, thin, threshold, all{true, true, true};
  uncertain.uncertain = true;
  uncertain.entropy_from = 0.6;
  slice.slice = Slice{0, 0.33, 4.0};
  thin = all;
  thin.slice = Slice{2, 0.55, 0.65};  // centres at its ends are in it
  threshold.unknown_from = 0.0;
  return {{}, all, {false, false, true}, uncertain, slice, thin, threshold, {false, false, false}};
}

/// How dark a corner is by counting the voxels that touch it in the layer before the face.
int occlusion_by_counting(const RandomMap& map, const VoxelFilter& filter, const VoxelFace& face, int corner) {
  const Vector3 at = face_corners(map.grid, face)[corner], normal = face_normal(face);
  const Vector3 middle = map.grid.centre(face.voxel) + 0.1 * normal;
  const Vector3 outward = (at + 0.05 * normal - middle) * 2;  // to the voxel beyond the corner
  std::vector<bool> beside;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == face.side / 2) continue;
    beside.push_back(map.shown(map.grid.cell_at(middle + outward[axis] * Vector3::Unit(axis)), filter));
  }
  if (beside[0] && beside[1]) return 3;
  return beside[0] + beside[1] + map.shown(map.grid.cell_at(middle + outward), filter);
}

TEST(ExposedFaces, AreThoseOfAPlainSearch) {
  // Rows shorter than a word of 64 voxels, as long as two, and a little longer.
  for (const Eigen::Vector3i& size : {Eigen::Vector3i(6, 5, 4), {128, 3, 3}, {131, 4, 2}, {1, 1, 1}}) {
    const RandomMap map(size, 3, 0.8);
    for (const VoxelFilter& filter : filters()) {
      std::vector<VoxelFace> expected;
      for (std::uint32_t voxel = 0; voxel < map.voxels.size(); ++voxel) {
        if (!map.shown(map.grid.cell(voxel), filter)) continue;
        for (std::uint8_t side = 0; side < 6; ++side) {
          VoxelFace face{voxel, side};
          if (map.shown(map.grid.cell(voxel) + face_normal(face).cast<int>(), filter)) continue;
          for (int corner = 0; corner < 4; ++corner)
            face.occlusion |= std::uint8_t(occlusion_by_counting(map, filter, face, corner) << (2 * corner));
          expected.push_back(face);
        }
      }
      EXPECT_EQ(exposed_faces(map.grid, map.voxels, filter), expected);
    }
  }
}

TEST(ExposedFaces, AreTheSameOnOneThread) {
  const RandomMap map({70, 40, 30}, 4, 0.5);
  const auto many = exposed_faces(map.grid, map.voxels, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(exposed_faces(map.grid, map.voxels, {}), many);
  EXPECT_GT(many.size(), 1000u);
}

TEST(ExposedFaces, ANookIsDarkAndAPlainIsOpen) {
  RandomMap map({3, 3, 3}, 5, 0.0);
  for (const Eigen::Vector3i& cell : {Eigen::Vector3i(1, 1, 0), {0, 1, 1}, {1, 0, 1}}) {
    map.voxels[map.grid.index(cell)] = {0.9f, 0.3f, VoxelClass::occupied, true, 0};
  }
  for (const VoxelFace& face : exposed_faces(map.grid, map.voxels, {})) {
    if (face.voxel != map.grid.index({1, 1, 0}) || face.side != 5) continue;
    // Its upper face lies beneath voxels on the sides of low x and of low y.
    EXPECT_EQ(face.occlusion_at(0), 3);
    EXPECT_EQ(face.occlusion_at(1), 1);
    EXPECT_EQ(face.occlusion_at(2), 0);
    EXPECT_EQ(face.occlusion_at(3), 1);
    return;
  }
  FAIL() << "the face is missing";
}

TEST(ExposedFaces, ASliceAlongNoAxisIsRefused) {
  const RandomMap map({2, 2, 2}, 6, 1.0);
  VoxelFilter filter;
  filter.slice = Slice{3, 0.0, 1.0};
  EXPECT_THROW(exposed_faces(map.grid, map.voxels, filter), std::invalid_argument);
}

/// The shown voxel whose box the ray enters first, by looking at every box.
std::optional<std::uint32_t> first_box(const RandomMap& map, const VoxelFilter& filter, const Vector3& origin,
                                       const Vector3& direction) {
  std::optional<std::uint32_t> first;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t voxel = 0; voxel < map.voxels.size(); ++voxel) {
    if (!map.shown(map.grid.cell(voxel), filter)) continue;
    const Eigen::Array3d a = (map.grid.centre(voxel) - origin).array() - 0.05, b = a + 0.1;
    const Eigen::Array3d to_a = a / direction.array(), to_b = b / direction.array();
    const double enter = std::max(0.0, to_a.min(to_b).maxCoeff()), leave = to_a.max(to_b).minCoeff();
    if (enter >= leave || enter >= nearest) continue;
    nearest = enter;
    first = voxel;
  }
  return first;
}

TEST(VoxelOnRay, IsTheFirstBoxThatTheRayEnters) {
  const RandomMap map({9, 8, 7}, 7, 0.25);
  std::size_t met = 0, missed = 0;
  for (const VoxelFilter& filter : filters()) {
    for (std::uint64_t i = 0; i < 400; ++i) {
      const auto draw = CounterRandom(8, 905).uniform(2 * i), more = CounterRandom(8, 905).uniform(2 * i + 1);
      const Vector3 origin = map.grid.lower() + 3.0 * Vector3(draw[0] - 0.4, draw[1] - 0.4, draw[2] - 0.4);
      const Vector3 target = map.grid.lower() + 0.9 * Vector3(more[0], more[1], more[2]);
      const auto voxel = voxel_on_ray(origin, target - origin, map.grid, map.voxels, filter);
      EXPECT_EQ(voxel, first_box(map, filter, origin, target - origin));
      ++(voxel ? met : missed);
    }
  }
  EXPECT_GT(met, 500u);
  EXPECT_GT(missed, 500u);
}

TEST(VoxelOnRay, AlongAnAxisAndFromWithin) {
  RandomMap map({5, 5, 5}, 9, 0.0);
  const std::uint32_t middle = map.grid.index({2, 2, 2});
  map.voxels[middle] = {0.9f, 0.3f, VoxelClass::occupied, true, 0};
  const Vector3 centre = map.grid.centre(middle);
  const auto hit = [&](const Vector3& origin, const Vector3& direction) {
    return voxel_on_ray(origin, direction, map.grid, map.voxels, {});
  };
  EXPECT_EQ(hit(centre - Vector3(40, 0, 0), Vector3(0.001, 0, 0)), middle) << "from far, a short direction";
  EXPECT_EQ(hit(centre, Vector3::UnitZ()), middle) << "from within";
  EXPECT_EQ(hit(centre - Vector3(40, 0, 0), -Vector3::UnitX()), std::nullopt) << "behind";
  EXPECT_THROW(hit(centre, Vector3::Zero()), std::invalid_argument);
  EXPECT_THROW(voxel_on_ray(centre, Vector3::UnitX(), map.grid, std::vector<Voxel>(3), {}), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
