#include "core/map/brick_kinds.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace nextview {
namespace {

/// The least log-odds of which an occupancy map makes at least this probability; infinite if none does.
float least_log_odds(double probability) {
  const auto reaches = [&](float log_odds) {
    return double(static_cast<float>(belief(log_odds).probability)) >= probability;
  };
  constexpr float largest = 1e4f;
  float below = -largest, from = largest;  // the larger the log-odds the likelier
  if (reaches(below)) return -std::numeric_limits<float>::infinity();
  if (!reaches(from)) return std::numeric_limits<float>::infinity();
  while (std::nextafter(below, from) < from) {
    const float middle = below + (from - below) / 2.0f;
    (reaches(middle) ? from : below) = middle;
  }
  return from;
}

/// `flags` are 0 or 1.
void pack(const std::array<std::uint8_t, VoxelBricks::brick_voxels>& flags, BrickKinds::Rows& rows) {
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::uint64_t eight;
    std::memcpy(&eight, &flags[row * sizeof eight], sizeof eight);
    constexpr std::uint64_t gather = 0x0102040810204080;  // the product has them side by side at its top
    rows[row] = static_cast<std::uint8_t>(eight * gather >> 56);
  }
}

}  // namespace

BrickKinds::BrickKinds(double threshold) : threshold_(threshold), occupied_from_(least_log_odds(threshold)) {}

void BrickKinds::read(const Brick& brick) {
  if (&brick == read_) return;
  read_ = &brick;
  if (brick.is_uniform()) {
    occupied.fill(is_occupied(brick, 0) ? 0xff : 0);
    unmeasured.fill(brick.measured(0) ? 0 : 0xff);
    return;
  }
  std::array<std::uint8_t, VoxelBricks::brick_voxels> are_occupied, are_unmeasured;
  for (std::size_t i = 0; i < are_unmeasured.size(); ++i) are_unmeasured[i] = !brick.measured(i);
  if (brick.follows_from_log_odds()) {
    const float* log_odds = brick.numbers().data();
    for (std::size_t i = 0; i < are_occupied.size(); ++i)
      are_occupied[i] = std::uint8_t(log_odds[i] >= occupied_from_) & std::uint8_t(!are_unmeasured[i]);
  } else {
    for (std::size_t i = 0; i < are_occupied.size(); ++i) are_occupied[i] = is_occupied(brick, i);
  }
  pack(are_occupied, occupied);
  pack(are_unmeasured, unmeasured);
}

}  // namespace nextview
