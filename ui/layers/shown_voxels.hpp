#pragma once
#include <span>
#include <vector>

#include "ui/appearance/voxel_filter.hpp"

namespace nextview {

/// A bit a voxel: whether it is drawn. 64 voxels along x share a word, so that neighbours are compared 64 at a time.
class ShownVoxels {
 public:
  /// @throws std::invalid_argument if the number of voxels is not the grid's, or the slice's axis is none.
  ShownVoxels(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter);

  int words_per_row() const { return words_; }
  /// The voxels along x at (y, z), the first in the lowest bit; a row of zeros beyond the grid.
  const std::uint64_t* row(int y, int z) const {
    const bool inside = unsigned(y) < unsigned(size_.y()) && unsigned(z) < unsigned(size_.z());
    return inside ? &bits_[(std::size_t(z) * size_.y() + y) * words_] : nothing_.data();
  }
  /// False beyond the grid.
  bool at(int x, int y, int z) const {
    return unsigned(x) < unsigned(size_.x()) && (row(y, z)[x / 64] >> (x % 64) & 1) != 0;
  }

 private:
  Eigen::Vector3i size_;
  int words_;
  std::vector<std::uint64_t> bits_, nothing_;
};

}  // namespace nextview
