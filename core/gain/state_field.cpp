#include "core/gain/state_field.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "core/map/grid_margin.hpp"

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

/// What a voxel is kept as, in one number; without a branch, which would be guessed wrong too often.
std::uint64_t key_of(const Brick& brick, std::size_t i, bool with_distance) {
  const auto heeded = -static_cast<std::uint32_t>(with_distance | brick.measured(i));
  return std::uint64_t{std::bit_cast<std::uint32_t>(brick.numbers()[i]) & heeded} << 8 | brick.states()[i];
}

/// Whose rays are added up, and how.
struct Scoring {
  const Gain& gain;
  double occupancy_threshold, occlusion_reach;

  double worth(const Voxel& voxel) const { return gain.worth(voxel, occlusion_reach); }
  double passes(const Voxel& voxel) const { return gain.weighs_visibility ? 1.0 - double(voxel.probability) : 1.0; }
  bool ends(const Voxel& voxel) const { return voxel.measured && voxel.probability >= occupancy_threshold; }
};

/// Numbers the states that there are, as they are met. Which number a state gets decides nothing.
class Numbering {
 public:
  /// `most`: how many states there may be, the margin's among them.
  Numbering(StateField& field, const Scoring& scoring, std::size_t most)
      : field_(field), scoring_(scoring), most_(most) {
    field_.worth.assign(1, 0.0);
    field_.passes.assign(1, 0.0);
  }

  std::uint16_t state(std::uint64_t key, const Voxel& voxel) {
    const std::scoped_lock lock(mutex_);
    if (const auto known = states_.find(key); known != states_.end()) return known->second;
    if (field_.worth.size() == most_) {
      too_many_ = true;
      return 0;
    }
    const auto state = static_cast<std::uint16_t>(2 * field_.worth.size() + scoring_.ends(voxel));
    field_.worth.push_back(scoring_.worth(voxel));
    field_.passes.push_back(scoring_.passes(voxel));
    return states_[key] = state;
  }
  bool too_many() const { return too_many_; }

 private:
  StateField& field_;
  const Scoring& scoring_;
  std::size_t most_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::uint16_t> states_;
  std::atomic<bool> too_many_ = false;
};

/// The states that a thread knows already.
class KnownStates {
 public:
  explicit KnownStates(Numbering& all) : all_(all) { keys_.fill(~std::uint64_t{0}); }
  std::uint16_t operator()(const Brick& brick, std::size_t i, bool with_distance) {
    const std::uint64_t key = key_of(brick, i, with_distance);
    const std::size_t slot = key * 0x9e3779b97f4a7c15u >> (64 - 8);
    if (keys_[slot] != key) {
      states_[slot] = all_.state(key, brick[i]);
      keys_[slot] = key;
    }
    return states_[slot];
  }

 private:
  Numbering& all_;
  std::array<std::uint64_t, 256> keys_;
  std::array<std::uint16_t, 256> states_{};
};

/// Whether two rows of a brick are kept as the same.
bool same_rows(const Brick& brick, std::size_t a, std::size_t b) {
  const auto same = [&](const auto& values) {
    using Row = std::array<std::uint64_t, VoxelBricks::edge * sizeof values[0] / sizeof(std::uint64_t)>;
    Row x, y;
    std::memcpy(&x, &values[a], sizeof x);
    std::memcpy(&y, &values[b], sizeof y);
    std::uint64_t differs = 0;
    for (std::size_t i = 0; i < x.size(); ++i) differs |= x[i] ^ y[i];
    return differs == 0;
  };
  return same(brick.numbers()) && same(brick.states());
}

/// Numbers the voxels of bricks beside each other along x.
template <class States>
class StatesOfBricks {
 public:
  using State = typename States::value_type;
  StatesOfBricks(const VoxelGrid& grid, const VoxelBricks& voxels, Numbering& numbering, bool with_distance,
                 States& states)
      : grid_(grid), voxels_(voxels), state_(numbering), with_distance_(with_distance), states_(states) {}

  /// Of `count` bricks from `first` on, as far as they are the same one whose voxels are all the same, or else of the
  /// first. How many it was.
  std::size_t number(std::size_t first, std::size_t count) {
    const Brick* const brick = &*voxels_.bricks()[first];
    if (brick != alike_ && !brick->is_uniform()) {
      number_rows(first);
      return 1;
    }
    alike_ = brick;  // many places share such a one
    std::size_t same = 1;
    while (same < count && &*voxels_.bricks()[first + same] == brick) ++same;
    const State state = this->state(*brick, 0);
    const Eigen::Vector3i lowest = voxels_.cell(first * VoxelBricks::brick_voxels);
    const std::size_t length =
        std::min(same * VoxelBricks::edge, std::size_t(grid_.size.x()) - std::size_t(lowest.x()));
    voxels_.for_each_row(first, [&](std::size_t, const Eigen::Vector3i& cell, std::size_t) {
      std::fill_n(&states_[place_with_margin(grid_, cell.x(), cell.y(), cell.z())], length, state);
    });
    return same;
  }

 private:
  State state(const Brick& brick, std::size_t i) { return static_cast<State>(state_(brick, i, with_distance_)); }

  void number_rows(std::size_t number) {
    const Brick& brick = *voxels_.bricks()[number];
    std::optional<std::size_t> before;  // the row that is known
    voxels_.for_each_row(number, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
      if (!before || !same_rows(brick, first, *before))  // most are as the one before
        for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = state(brick, first + i);
      before = first;
      State* const to = &states_[place_with_margin(grid_, cell.x(), cell.y(), cell.z())];
      if (count == row_.size())
        std::memcpy(to, row_.data(), sizeof row_);  // of a size that the compiler knows
      else
        std::copy_n(row_.begin(), count, to);
    });
  }

  const VoxelGrid& grid_;
  const VoxelBricks& voxels_;
  KnownStates state_;
  bool with_distance_;
  States& states_;
  const Brick* alike_ = nullptr;  ///< the last one whose voxels are all the same
  std::array<State, VoxelBricks::edge> row_{};
};

/// Fills `states`, one of the field's, with what the voxels are kept as. Whether there were few enough of them.
template <class States>
bool number_states(const VoxelGrid& grid, const VoxelBricks& voxels, const Scoring& scoring, StateField& field,
                   States& states) {
  using State = typename States::value_type;
  states.resize(places_with_margin(grid) + StateField::read_beyond / sizeof(State));
  constexpr State outside = StateField::outside;
  fill_margin_layers(grid, states, outside);
  Numbering numbering(field, scoring, std::size_t{1} << (8 * sizeof(State) - 1));
  const auto along_x = std::max<std::size_t>(1, std::size_t(voxels.brick_edges().x()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count() / along_x, 4), [&](const auto& range) {
    StatesOfBricks<States> bricks(grid, voxels, numbering, scoring.gain.needs_occlusion, states);
    for (std::size_t row = range.begin(); row != range.end(); ++row) {
      for (std::size_t x = 0; x < along_x && !numbering.too_many();) x += bricks.number(row * along_x + x, along_x - x);
      voxels.for_each_row(row * along_x, [&](std::size_t, const Eigen::Vector3i& cell, std::size_t) {
        fill_margin_of_row(grid, cell.y(), cell.z(), states, outside);
      });
    }
  });
  if (numbering.too_many()) states.clear();
  return !states.empty();
}

/// The field of voxels that are all different.
void fill_places(const VoxelGrid& grid, const VoxelBricks& voxels, const Scoring& scoring, StateField& field) {
  field.worth.assign(places_with_margin(grid), 0.0);
  field.passes.assign(places_with_margin(grid), -2.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count(), 64), [&](const auto& range) {
    for (std::size_t b = range.begin(); b != range.end(); ++b)
      voxels.for_each_row(b, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
        const std::size_t place = place_with_margin(grid, cell.x(), cell.y(), cell.z());
        for (std::size_t i = 0; i < count; ++i) {
          const Voxel voxel = (*voxels.bricks()[b])[first + i];
          field.worth[place + i] = scoring.worth(voxel);
          field.passes[place + i] = scoring.ends(voxel) ? -scoring.passes(voxel) : scoring.passes(voxel);
        }
      });
  });
}

bool follows_from_log_odds(const VoxelBricks& voxels) {
  return std::ranges::all_of(voxels.bricks(), [](const auto& brick) { return brick->follows_from_log_odds(); });
}

}  // namespace

std::optional<StateField> state_field(const VoxelGrid& grid, const VoxelBricks& voxels, double occupancy_threshold,
                                      const Gain& gain, double occlusion_reach) {
  if (!gain.worth) return std::nullopt;
  StateField field;
  const Scoring scoring{gain, occupancy_threshold, occlusion_reach};
  if (!follows_from_log_odds(voxels) || (!number_states(grid, voxels, scoring, field, field.bytes) &&
                                         !number_states(grid, voxels, scoring, field, field.shorts)))
    fill_places(grid, voxels, scoring, field);
  // Without visibility nothing is too small to count.
  field.most_worth =
      gain.weighs_visibility ? *std::ranges::max_element(field.worth) : std::numeric_limits<double>::infinity();
  return field;
}

}  // namespace nextview
