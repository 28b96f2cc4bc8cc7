#include "core/map/voxel_grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nextview {

VoxelGrid region_of_interest(const Vector3& centre, double edge, double resolution) {
  const double voxels = std::ceil(edge / resolution - 1e-6);
  if (!(voxels >= 1.0 && voxels <= most_voxels_along_side))
    throw std::invalid_argument(
        fmt::format("region of interest: an edge of {} m at a resolution of {} m makes {} voxels along each side; it "
                    "must be from 1 to {}",
                    edge, resolution, voxels, most_voxels_along_side));
  const Vector3 first = (centre / resolution - Vector3::Constant(0.5 * voxels)).array().round();
  if (!(first.array().abs() + voxels <= 32768.0).all())  // an octree's 16 bits an axis
    throw std::invalid_argument(
        fmt::format("region of interest: its centre ({}, {}, {}) m must lie within {} m of the world's origin",
                    centre.x(), centre.y(), centre.z(), 32768.0 * resolution));
  VoxelGrid grid;
  grid.resolution = resolution;
  grid.size.setConstant(static_cast<int>(voxels));
  grid.first = first.cast<int>();
  return grid;
}

VoxelGrid region_of_interest(const Eigen::AlignedBox3d& box, double resolution) {
  constexpr double slack = 1e-6;  // a side on a voxel's face, give or take rounding [voxels]
  const Vector3 first = (box.min().array() / resolution + slack).floor();
  const Vector3 last = (box.max().array() / resolution - slack).ceil();
  const Vector3 size = last - first;
  if (!((size.array() >= 1.0) && (size.array() <= most_voxels_along_side)).all())
    throw std::invalid_argument(
        fmt::format("region of interest: a box of {} x {} x {} m at a resolution of {} m must be from 1 to {} voxels "
                    "along each side",
                    box.sizes().x(), box.sizes().y(), box.sizes().z(), resolution, most_voxels_along_side));
  if (!(first.array().abs() <= 32768.0).all() || !(last.array().abs() <= 32768.0).all())  // an octree's 16 bits an axis
    throw std::invalid_argument(
        fmt::format("region of interest: it must lie within {} m of the world's origin", 32768.0 * resolution));
  return {resolution, first.cast<int>(), size.cast<int>()};
}

}  // namespace nextview
