#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/evaluation/map_quality.hpp"

namespace nextview {

/// What a voxel that scores may count is: these bits together.
using VoxelFacts = unsigned;
inline constexpr VoxelFacts is_occupied = 1, is_in_band = 2, is_visited = 4;
inline constexpr VoxelFacts all_facts = 8;  ///< how many combinations there are

/// What a voxel adds to the sums.
struct QualityTerms {
  double log_loss, brier, divergence;
  std::size_t bin;
};

/// The sums over a scored set's voxels that its quality follows from.
struct QualitySums {
  std::size_t voxels = 0;
  double log_loss = 0.0, brier = 0.0, divergence = 0.0, divergence_outside = 0.0;
  struct Bin {
    std::size_t voxels = 0, occupied = 0;
    double probability = 0.0;
  };
  std::array<Bin, 10> bins;

  /// So many voxels that are alike.
  void add(double p, VoxelFacts facts, const QualityTerms& terms, std::size_t count);
  QualitySums& operator+=(const QualitySums& other);
  MapQuality quality() const;
};

/// The sums of several scored sets.
class QualitySumsOfSets {
 public:
  explicit QualitySumsOfSets(std::span<const ScoredSet> sets);
  /// Whether one of the sets counts voxels that are this.
  bool counts(VoxelFacts facts) const { return counted_in_[facts] != 0; }
  void add(double p, VoxelFacts facts, const QualityTerms& terms, std::size_t count);
  QualitySumsOfSets& operator+=(const QualitySumsOfSets& other);
  MapQuality quality(ScoredSet set) const { return sums_[static_cast<std::size_t>(set)].quality(); }

 private:
  std::array<unsigned, all_facts> counted_in_{};  ///< in which sets, a bit each
  std::array<QualitySums, 4> sums_;
};

/// Counts voxels that are alike before it adds them to sums: an occupancy map has few different probabilities, and
/// logarithms are expensive.
class AlikeVoxels {
 public:
  explicit AlikeVoxels(QualitySumsOfSets& sums) : sums_(sums), counts_(slots * all_facts) {}
  ~AlikeVoxels();
  AlikeVoxels(const AlikeVoxels&) = delete;

  void add(float p, VoxelFacts facts, std::size_t count) {
    const std::size_t slot = std::bit_cast<std::uint32_t>(p) * 0x9e3779b1u >> (32 - slot_bits);
    Count& counted = counts_[slot * all_facts + facts];
    if (counted.p != p) {
      flush(counted, facts);
      counted.p = p;
    }
    counted.voxels += count;
  }

 private:
  static constexpr int slot_bits = 7;
  static constexpr std::size_t slots = std::size_t{1} << slot_bits;
  struct Count {
    float p = -1.0f;
    std::size_t voxels = 0;
  };
  void flush(Count& count, VoxelFacts facts);

  QualitySumsOfSets& sums_;
  std::vector<Count> counts_;  ///< the facts of a slot side by side
};

}  // namespace nextview
