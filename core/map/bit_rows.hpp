#pragma once
#include <cstdint>
#include <stop_token>
#include <vector>

#include "core/map/bit_mask.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// A flag for each voxel of a box, those of a row along x in words of their own: so that 64 voxels are worked on at
/// once. All false at first. What works on all of them @throws Stopped.
class BitRows {
 public:
  explicit BitRows(const Eigen::Vector3i& size);

  /// From several threads at once.
  void set(const Eigen::Vector3i& cell);
  void flip(const Eigen::Vector3i& cell);

  /// Makes each flag the parity of those up to it along an axis, itself among them; but clears the columns that are set
  /// in `left_out`, whose size along the axis is 1.
  void accumulate(int axis, const BitRows& left_out, const std::stop_token& stop);
  /// Sets those that have a neighbour that is set, of 26.
  void grow(const std::stop_token& stop);
  /// Each is what two of the three are.
  static BitRows majority(const BitRows& a, const BitRows& b, const BitRows& c);

  BitMask mask() const;  ///< x fastest, then y, then z

 private:
  std::size_t row(int y, int z) const { return (std::size_t(z) * size_.y() + y) * row_words_; }
  std::uint64_t& word_of(const Eigen::Vector3i& cell) { return words_[row(cell.y(), cell.z()) + cell.x() / 64]; }
  void grow_along_rows();
  template <class Visit>
  void for_each_column_of_rows(int axis, const std::stop_token& stop, Visit visit);

  Eigen::Vector3i size_;
  std::size_t row_words_;
  std::uint64_t last_word_;  ///< the flags of a row's last word that are of voxels
  std::vector<std::uint64_t> words_;
};

}  // namespace nextview
