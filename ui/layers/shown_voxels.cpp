#include "ui/layers/shown_voxels.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace nextview {
namespace {

bool within(const VoxelGrid& grid, const VoxelFilter& filter, int axis, int cell) {
  return filter.holds(axis, (grid.first[axis] + cell + 0.5) * grid.resolution);  // as VoxelGrid::centre
}

/// A bit a cell along x, whether slice and section leave it; in words as ShownVoxels has them.
std::vector<std::uint64_t> cells_within(const VoxelGrid& grid, const VoxelFilter& filter, int words) {
  std::vector<std::uint64_t> bits(std::size_t(words), 0);
  for (int x = 0; x < grid.size.x(); ++x)
    bits[std::size_t(x / 64)] |= std::uint64_t(within(grid, filter, 0, x)) << (x % 64);
  return bits;
}

/// The smallest float that is not less: comparing floats with it is comparing them with `value`.
float at_least(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

/// VoxelFilter::shows without branches, which would be mispredicted: a voxel is shown from some value on.
struct Threshold {
  std::array<float, 3> from;  ///< by class: the least probability (or entropy) that is shown

  explicit Threshold(const VoxelFilter& filter) {
    constexpr float all = -1.0f, none = 2.0f;
    from = {filter.unknown ? at_least(filter.unknown_from) : none, filter.free ? all : none,
            filter.occupied ? all : none};
    if (filter.uncertain) from.fill(at_least(filter.entropy_from));
  }
  template <float Voxel::*value>
  std::uint64_t word(const Voxel* first, std::size_t count) const {
    std::uint64_t bits = 0;
    for (std::size_t i = count; i-- > 0;) {
      const Voxel& voxel = first[i];
      bits = bits << 1 | (unsigned(voxel.measured) & unsigned(voxel.*value >= from[std::size_t(voxel.voxel_class)]));
    }
    return bits;
  }
};

}  // namespace

ShownVoxels::ShownVoxels(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter)
    : size_(grid.size), words_((grid.size.x() + 63) / 64) {
  if (voxels.size() != grid.voxel_count()) throw std::invalid_argument("voxels: their number is not the grid's");
  if (filter.slice && (filter.slice->axis < 0 || filter.slice->axis > 2))
    throw std::invalid_argument("slice: the axis must be 0, 1 or 2");
  if (filter.section && (filter.section->axis < 0 || filter.section->axis > 2))
    throw std::invalid_argument("section: the axis must be 0, 1 or 2");
  bits_.resize(std::size_t(words_) * size_.y() * size_.z());
  nothing_.resize(std::size_t(words_));
  const auto cells = cells_within(grid, filter, words_);
  const Threshold threshold(filter);
  const std::size_t row_length = std::size_t(size_.x());
  tbb::parallel_for(0, size_.z(), [&](int z) {
    for (int y = 0; y < size_.y() && within(grid, filter, 2, z); ++y) {
      if (!within(grid, filter, 1, y)) continue;
      const std::size_t row = std::size_t(z) * size_.y() + y;
      for (std::size_t x = 0; x < row_length; x += 64) {
        const Voxel* first = &voxels[row * row_length + x];
        const std::size_t count = std::min<std::size_t>(64, row_length - x);
        bits_[row * words_ + x / 64] =
            cells[x / 64] & (filter.uncertain ? threshold.word<&Voxel::entropy>(first, count)
                                              : threshold.word<&Voxel::probability>(first, count));
      }
    }
  });
}

}  // namespace nextview
