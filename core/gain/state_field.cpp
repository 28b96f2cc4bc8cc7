#include "core/gain/state_field.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <mutex>
#include <unordered_map>

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

/// What a voxel is kept as, in one number.
std::uint64_t key_of(const Brick& brick, std::size_t i, bool with_distance) {
  const float number = with_distance || brick.measured(i) ? brick.numbers()[i] : 0.0f;
  return std::uint64_t{std::bit_cast<std::uint32_t>(number)} << 8 | brick.states()[i];
}

/// Numbers the states that there are, as they are met. Which number a state gets decides nothing.
class Numbering {
 public:
  Numbering(StateField& field, const Gain& gain, double threshold, double reach)
      : field_(field), gain_(gain), threshold_(threshold), reach_(reach) {}

  std::uint8_t number(std::uint64_t key, const Voxel& voxel) {
    const std::scoped_lock lock(mutex_);
    if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;
    const bool ends = voxel.measured && voxel.probability >= threshold_;
    std::size_t& count = counts_[ends];
    if (count == StateField::most_states) {
      too_many_ = true;
      return 0;
    }
    const auto number = static_cast<std::uint8_t>(count++ + (ends ? StateField::ends : 0));
    field_.worth[number] = gain_.worth(voxel, reach_);
    field_.passes[number] = gain_.weighs_visibility ? 1.0 - double(voxel.probability) : 1.0;
    return numbers_[key] = number;
  }
  bool too_many() const { return too_many_; }

 private:
  StateField& field_;
  const Gain& gain_;
  double threshold_, reach_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::uint8_t> numbers_;
  std::array<std::size_t, 2> counts_{};
  std::atomic<bool> too_many_ = false;
};

/// The numbers that a thread knows already.
class KnownNumbers {
 public:
  explicit KnownNumbers(Numbering& all) : all_(all) { keys_.fill(~std::uint64_t{0}); }
  std::uint8_t operator()(const Brick& brick, std::size_t i, bool with_distance) {
    const std::uint64_t key = key_of(brick, i, with_distance);
    const std::size_t slot = key * 0x9e3779b97f4a7c15u >> (64 - 8);
    if (keys_[slot] != key) {
      numbers_[slot] = all_.number(key, brick[i]);
      keys_[slot] = key;
    }
    return numbers_[slot];
  }

 private:
  Numbering& all_;
  std::array<std::uint64_t, 256> keys_;
  std::array<std::uint8_t, 256> numbers_{};
};

/// Writes the states of a brick to where they stand in the field.
void number_brick(const VoxelGrid& grid, const Brick& brick, const Eigen::Vector3i& first, bool with_distance,
                  KnownNumbers& number, std::vector<std::uint8_t>& states) {
  const Eigen::Vector3i size = (grid.size - first).cwiseMin(VoxelBricks::edge);
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y) {
      std::uint8_t* const row = &states[place_with_margin(grid, first.x(), first.y() + y, first.z() + z)];
      const std::size_t in_brick = std::size_t(z * VoxelBricks::edge + y) * VoxelBricks::edge;
      for (int x = 0; x < size.x(); ++x) row[x] = number(brick, in_brick + std::size_t(x), with_distance);
    }
}

}  // namespace

std::optional<StateField> state_field(const VoxelGrid& grid, const VoxelBricks& voxels, double occupancy_threshold,
                                      const Gain& gain, double occlusion_reach) {
  if (!gain.worth) return std::nullopt;
  StateField field;
  field.states.assign(places_with_margin(grid) + StateField::read_beyond, StateField::outside);
  Numbering numbering(field, gain, occupancy_threshold, occlusion_reach);
  std::atomic<bool> is_told = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count(), 64), [&](const auto& range) {
    KnownNumbers number(numbering);
    for (std::size_t b = range.begin(); b != range.end(); ++b) {
      const Brick& brick = *voxels.bricks()[b];
      if (!brick.follows_from_log_odds()) is_told = true;
      if (is_told || numbering.too_many()) return;
      number_brick(grid, brick, voxels.cell(b * VoxelBricks::brick_voxels), gain.needs_occlusion, number, field.states);
    }
  });
  if (is_told || numbering.too_many()) return std::nullopt;
  // Without visibility nothing is too small to count.
  field.most_worth =
      gain.weighs_visibility ? *std::ranges::max_element(field.worth) : std::numeric_limits<double>::infinity();
  return field;
}

}  // namespace nextview
