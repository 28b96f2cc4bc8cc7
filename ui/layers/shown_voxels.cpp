#include "ui/layers/shown_voxels.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace nextview {
namespace {

/// Which cells along each axis the slice leaves.
std::array<std::vector<std::uint8_t>, 3> cells_within(const VoxelGrid& grid, const std::optional<Slice>& slice) {
  std::array<std::vector<std::uint8_t>, 3> within;
  for (int axis = 0; axis < 3; ++axis) {
    within[axis].assign(std::size_t(grid.size[axis]), 1);
    if (!slice || slice->axis != axis) continue;
    for (int i = 0; i < grid.size[axis]; ++i) {
      const double centre = (grid.first[axis] + i + 0.5) * grid.resolution;  // as VoxelGrid::centre
      within[axis][std::size_t(i)] = slice->holds(centre);
    }
  }
  return within;
}

}  // namespace

ShownVoxels::ShownVoxels(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter)
    : size_(grid.size), words_((grid.size.x() + 63) / 64) {
  if (voxels.size() != grid.voxel_count()) throw std::invalid_argument("voxels: their number is not the grid's");
  if (filter.slice && (filter.slice->axis < 0 || filter.slice->axis > 2))
    throw std::invalid_argument("slice: the axis must be 0, 1 or 2");
  bits_.resize(std::size_t(words_) * size_.y() * size_.z());
  nothing_.resize(std::size_t(words_));
  const auto within = cells_within(grid, filter.slice);
  const std::size_t row_length = std::size_t(size_.x());
  tbb::parallel_for(0, size_.z(), [&](int z) {
    for (int y = 0; y < size_.y(); ++y) {
      if (!within[1][std::size_t(y)] || !within[2][std::size_t(z)]) continue;
      const std::size_t row = std::size_t(z) * size_.y() + y;
      const Voxel* first = &voxels[row * row_length];
      for (std::size_t x = 0; x < row_length; x += 64) {
        const std::size_t end = std::min<std::size_t>(64, row_length - x);
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < end; ++i)
          word |= std::uint64_t(filter.shows(first[x + i]) & (within[0][x + i] != 0)) << i;
        bits_[row * words_ + x / 64] = word;
      }
    }
  });
}

}  // namespace nextview
