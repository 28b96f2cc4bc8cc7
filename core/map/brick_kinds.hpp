#pragma once
#include <array>
#include <cstdint>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// What the voxels of a brick are, row by row, a bit each.
class BrickKinds {
 public:
  using Brick = VoxelBricks::Brick;
  static constexpr int edge = VoxelBricks::edge;
  using Rows = std::array<std::uint8_t, std::size_t{edge} * edge>;
  Rows occupied{}, unmeasured{};

  /// `threshold`: the probability from which on a measured voxel is occupied.
  explicit BrickKinds(double threshold);
  /// Where a row begins in its brick.
  static Eigen::Vector3i cell(int row) { return {0, row % edge, row / edge}; }
  /// Bricks that many places share come one after the other: they are read once.
  void read(const Brick& brick);

 private:
  bool is_occupied(const Brick& brick, std::size_t i) const {
    if (!brick.measured(i)) return false;
    return brick.follows_from_log_odds() ? brick.numbers()[i] >= occupied_from_ : brick[i].probability >= threshold_;
  }

  double threshold_;
  float occupied_from_;  ///< the least log-odds
  const Brick* read_ = nullptr;
};

}  // namespace nextview
