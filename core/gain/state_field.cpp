#include "core/gain/state_field.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <mutex>
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

/// Calls `work(bricks)` for ranges of all bricks, several at once.
template <class Work>
void for_ranges_of_bricks(const VoxelBricks& voxels, Work work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count(), 64), work);
}

/// Fills `states`, one of the field's, with what the voxels are kept as. Whether there were few enough of them.
template <class States>
bool number_states(const VoxelGrid& grid, const VoxelBricks& voxels, const Scoring& scoring, StateField& field,
                   States& states) {
  using State = typename States::value_type;
  states.resize(places_with_margin(grid) + StateField::read_beyond / sizeof(State));
  fill_margin(grid, states, State{StateField::outside});
  Numbering numbering(field, scoring, std::size_t{1} << (8 * sizeof(State) - 1));
  for_ranges_of_bricks(voxels, [&](const auto& range) {
    KnownStates state(numbering);
    std::array<State, VoxelBricks::edge> row{};
    const Brick* alike = nullptr;  // the last brick, if its voxels are all the same: many places share such a one
    for (std::size_t b = range.begin(); b != range.end() && !numbering.too_many(); ++b) {
      const Brick& brick = *voxels.bricks()[b];
      constexpr std::size_t none = VoxelBricks::brick_voxels;
      std::size_t before = &brick == alike ? 0 : none;  // the row of this brick that is known
      if (before == none) alike = brick.is_uniform() ? &brick : nullptr;
      voxels.for_each_row(b, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
        // Most are as the one before: where nothing is, or nothing was seen. Else all of it is numbered: where the
        // brick stands once more, more of it may be in the grid.
        if (before == none || !(alike || same_rows(brick, first, before)))
          for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = static_cast<State>(state(brick, first + i, scoring.gain.needs_occlusion));
        before = first;
        State* const to = &states[place_with_margin(grid, cell.x(), cell.y(), cell.z())];
        if (count == row.size())
          std::memcpy(to, row.data(), sizeof row);  // of a size that the compiler knows
        else
          std::copy_n(row.begin(), count, to);
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
  for_ranges_of_bricks(voxels, [&](const auto& range) {
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
