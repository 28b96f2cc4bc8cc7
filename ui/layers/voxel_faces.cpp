#include "ui/layers/voxel_faces.hpp"

#include <array>
#include <stdexcept>

namespace nextview {

std::vector<VoxelFace> exposed_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter) {
  if (voxels.size() != grid.voxel_count()) throw std::invalid_argument("voxels: their number is not the grid's");
  std::vector<VoxelFace> faces;
  for (std::uint32_t voxel = 0; voxel < voxels.size(); ++voxel) {
    if (!filter.shows(voxels[voxel])) continue;
    const Eigen::Vector3i cell = grid.cell(voxel);
    for (std::uint8_t side = 0; side < 6; ++side) {
      Eigen::Vector3i neighbour = cell;
      neighbour[side / 2] += side % 2 ? 1 : -1;
      if (!grid.contains(neighbour) || !filter.shows(voxels[grid.index(neighbour)])) faces.push_back({voxel, side});
    }
  }
  return faces;
}

std::array<Vector3, 4> face_corners(const VoxelGrid& grid, const VoxelFace& face) {
  const int axis = face.side / 2, positive = face.side % 2;
  // Right-handed around the outward normal: the two other axes in cyclic order, exchanged on the negative side.
  const int u = (axis + (positive ? 1 : 2)) % 3, v = (axis + (positive ? 2 : 1)) % 3;
  Eigen::Vector3i lowest = grid.first + grid.cell(face.voxel);
  lowest[axis] += positive;
  std::array<Vector3, 4> result;
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::Vector3i at = lowest;
    at[u] += corner == 1 || corner == 2;
    at[v] += corner >= 2;
    result[corner] = at.cast<double>() * grid.resolution;
  }
  return result;
}

Vector3 face_normal(const VoxelFace& face) { return (face.side % 2 ? 1.0 : -1.0) * Vector3::Unit(face.side / 2); }

}  // namespace nextview
