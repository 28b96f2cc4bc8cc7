#include "ui/layers/coarse_voxels.hpp"

namespace nextview {
namespace {

/// Rounded down; also below 0.
Eigen::Vector3i halved(const Eigen::Vector3i& cell, int times) {
  return {cell.x() >> times, cell.y() >> times, cell.z() >> times};
}

}  // namespace

CoarseVoxels coarse_voxels(const VoxelGrid& grid, std::span<const VoxelFace> faces, int halvings) {
  CoarseVoxels result;
  const Eigen::Vector3i first = halved(grid.first, halvings);
  const Eigen::Vector3i last = halved(grid.first + grid.size - Eigen::Vector3i::Ones(), halvings);
  result.grid = {grid.resolution * (1 << halvings), first, last - first + Eigen::Vector3i::Ones()};
  const auto cell_of = [&](const VoxelFace& face) -> Eigen::Vector3i {
    return halved(grid.first + grid.cell(face.voxel), halvings) - first;
  };
  std::vector<std::uint8_t> sides(result.grid.voxel_count(), 0);  // a bit each
  for (const VoxelFace& face : faces) sides[result.grid.index(cell_of(face))] |= 1 << face.side;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Eigen::Vector3i cell = cell_of(faces[i]);
    const std::uint32_t voxel = result.grid.index(cell);
    const std::uint8_t bit = 1 << faces[i].side, taken = 1 << 6;
    if (!(sides[voxel] & bit)) continue;  // it is there
    sides[voxel] = std::uint8_t((sides[voxel] & ~bit) | taken);
    const Eigen::Vector3i next = cell + (faces[i].side % 2 ? 1 : -1) * Eigen::Vector3i::Unit(faces[i].side / 2);
    if (result.grid.contains(next) && sides[result.grid.index(next)]) continue;
    result.faces.push_back({voxel, faces[i].side, 0});
    result.stand_for.push_back(i);
  }
  return result;
}

}  // namespace nextview
