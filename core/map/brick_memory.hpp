#pragma once
#include <array>
#include <cstdint>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// What was found of the bricks, or pairs of them, that were met last: many places share one.
template <class Value>
class BrickMemory {
 public:
  using Brick = VoxelBricks::Brick;
  /// `find()`, if it was not found already. All bricks that are asked about must live as long as this.
  template <class Find>
  Value of(const Brick& a, const Brick& b, Find find) {
    Known& known = known_[(address(a) * 3 + address(b)) * 0x9e3779b97f4a7c15u >> (64 - 6)];
    if (known.a != &a || known.b != &b) known = {&a, &b, find()};
    return known.value;
  }
  template <class Find>
  Value of(const Brick& brick, Find find) {
    return of(brick, brick, find);
  }

 private:
  static std::uint64_t address(const Brick& brick) { return reinterpret_cast<std::uintptr_t>(&brick); }
  struct Known {
    const Brick *a = nullptr, *b = nullptr;
    Value value{};
  };
  std::array<Known, 64> known_{};
};

/// What is believed of a brick's voxels, asked for one after the other: many are as the one before.
class BrickBeliefs {
 public:
  explicit BrickBeliefs(const VoxelBricks::Brick& brick) : brick_(brick) {}
  float probability(std::size_t i) { return as_believed(i).probability; }
  float entropy(std::size_t i) { return as_believed(i).entropy; }

 private:
  const Voxel& as_believed(std::size_t i) {
    const float log_odds = brick_.log_odds(i);
    if (log_odds != log_odds_ || !brick_.follows_from_log_odds()) log_odds_ = log_odds, voxel_ = brick_[i];
    return voxel_;
  }

  const VoxelBricks::Brick& brick_;
  float log_odds_ = 0.0f;
  Voxel voxel_;  ///< that was asked about last, or one as likely; of log-odds 0: an unmeasured one
};

}  // namespace nextview
