#include "core/map/voxel_grid.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nextview {

VoxelGrid region_of_interest(const Vector3& centre, double edge, double resolution) {
  const double voxels = std::ceil(edge / resolution - 1e-6);
  if (!(voxels >= 1.0 && voxels <= 1024.0))
    throw std::invalid_argument(fmt::format(
        "region of interest: an edge of {} m at a resolution of {} m makes {} voxels along each side; it must be from 1 to 1024",
        edge, resolution, voxels));
  VoxelGrid grid;
  grid.resolution = resolution;
  grid.size.setConstant(static_cast<int>(voxels));
  grid.first = (centre / resolution - Vector3::Constant(0.5 * voxels)).array().round().matrix().cast<int>();
  return grid;
}

}  // namespace nextview
