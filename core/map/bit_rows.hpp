#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/map/bit_mask.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// A flag for each voxel of a box, those of a row along x in words of their own: so that 64 voxels are worked on at
/// once. All false at first. What works on all of them @throws Stopped.
class BitRows {
 public:
  explicit BitRows(const Eigen::Vector3i& size = Eigen::Vector3i::Zero());

  const Eigen::Vector3i& size() const { return size_; }
  bool at(const Eigen::Vector3i& cell) const { return row(cell.y(), cell.z())[cell.x() / 64] >> (cell.x() % 64) & 1; }
  /// Those of a row, 64 a word, the lowest first; none is set beyond the row's end.
  std::span<const std::uint64_t> row(int y, int z) const { return {&words_[begin(y, z)], row_words_}; }

  /// From several threads at once.
  void set(const Eigen::Vector3i& cell);
  void flip(const Eigen::Vector3i& cell);
  /// Sets those of eight from `first` on whose bit is 1, the lowest first; what is beyond either end of the row is left
  /// out. Other threads may work on other rows.
  void set_eight(const Eigen::Vector3i& first, std::uint8_t bits);

  /// Makes each flag the parity of those up to it along an axis, itself among them; but clears the columns that are set
  /// in `left_out`, whose size along the axis is 1.
  void accumulate(int axis, const BitRows& left_out, const std::stop_token& stop);
  /// Sets those that have a neighbour that is set, of 26.
  void grow(const std::stop_token& stop);
  /// Each is what two of the three are.
  static BitRows majority(const BitRows& a, const BitRows& b, const BitRows& c);
  static BitRows either(const BitRows& a, const BitRows& b);
  BitRows complement() const;
  /// A flag for each 2 x 2 x 2 voxels, or as many as lie in the box: whether any of them is set.
  BitRows halved() const;

  /// How many of a voxel's 26 neighbours are set; beyond the box there are none.
  int neighbours(const Eigen::Vector3i& cell) const;
  /// The sum of the ways to those: on which side of the voxel most of them lie [voxels].
  Eigen::Vector3i ways_to_neighbours(const Eigen::Vector3i& cell) const;
  /// How many are set before each word, x fastest, then y, then z; at last how many in all.
  std::vector<std::uint32_t> counts_before() const;
  /// How many are set before a voxel. @pre `counts` is counts_before()
  std::size_t rank(const Eigen::Vector3i& cell, const std::vector<std::uint32_t>& counts) const {
    const std::size_t word = begin(cell.y(), cell.z()) + cell.x() / 64;
    const std::uint64_t lower = (std::uint64_t{1} << (cell.x() % 64)) - 1;
    return counts[word] + std::size_t(std::popcount(words_[word] & lower));
  }
  /// Calls `visit(x)` for those of a row that are set.
  template <class Visit>
  void for_each_in_row(int y, int z, Visit visit) const {
    const std::span<const std::uint64_t> words = row(y, z);
    for (std::size_t w = 0; w < words.size(); ++w)
      for (std::uint64_t bits = words[w]; bits != 0; bits &= bits - 1)
        visit(static_cast<int>(64 * w) + std::countr_zero(bits));
  }

  BitMask mask() const;  ///< x fastest, then y, then z

 private:
  /// A voxel's flag and its neighbours', x fastest, then y, then z, the lowest first; beyond the box there are none.
  std::uint32_t around(const Eigen::Vector3i& cell) const;
  std::size_t begin(int y, int z) const { return (std::size_t(z) * size_.y() + y) * row_words_; }
  std::uint64_t& word_of(const Eigen::Vector3i& cell) { return words_[begin(cell.y(), cell.z()) + cell.x() / 64]; }
  void grow_along_rows();
  template <class Visit>
  void for_each_column_of_rows(int axis, const std::stop_token& stop, Visit visit);

  Eigen::Vector3i size_;
  std::size_t row_words_;
  std::uint64_t last_word_;  ///< the flags of a row's last word that are of voxels
  std::vector<std::uint64_t> words_;
};

}  // namespace nextview
