#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/gibbs/sites.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {

/// Moves that exchange the levels of neighbouring voxels near a return. They leave the posterior as it is, and carry a
/// surface along the rays without its having to vanish first. State: SurvivalState or FirstHitState.
template <class State>
class NeighbourMoves {
 public:
  NeighbourMoves(const VoxelGrid& grid, const Sites& sites, State& state)
      : grid_(grid),
        sites_(sites),
        state_(state),
        stride_{1u, std::uint32_t(grid.size.x()), std::uint32_t(grid.size.x() * grid.size.y())} {}

  /// Neighbours exchange their levels (Metropolis; the pair does not depend on the map, so the proposal is symmetric,
  /// and the prior does not change).
  /// Returns how many voxels changed.
  std::size_t swap(const CounterRandom& draws) {
    std::size_t changed = 0;
    for (const std::uint32_t a : sites_.near_voxels) {
      std::uint32_t b;
      const auto u = draws.uniform(a);
      if (!neighbour(a, static_cast<int>(3.0 * u[0]), b)) continue;
      const std::uint8_t level_a = state_.map()[a], level_b = state_.map()[b];
      if (level_a == level_b) continue;
      const double change = state_.change(a, level_b) + state_.change(b, level_a);
      if (std::log(u[1]) <= change) {
        changed += 2;
        continue;
      }
      state_.set(b, level_b);
      state_.set(a, level_a);
    }
    return changed;
  }

  /// Four voxels in a square exchange their levels: drawn from all arrangements, each with its exact probability.
  std::size_t redraw_plaquettes(const CounterRandom& draws) {
    std::size_t changed = 0;
    for (const std::uint32_t corner : sites_.near_voxels) {
      const auto u = draws.uniform(corner);
      const int axis = static_cast<int>(3.0 * u[0]);
      std::array<std::uint32_t, 4> voxels{corner};
      if (!neighbour(corner, axis, voxels[1]) || !neighbour(corner, (axis + 1) % 3, voxels[2]) ||
          !neighbour(voxels[1], (axis + 1) % 3, voxels[3]))
        continue;
      changed += redraw(voxels, u[1]);
    }
    return changed;
  }

 private:
  std::size_t redraw(const std::array<std::uint32_t, 4>& voxels, double u) {
    std::array<std::uint8_t, 4> levels, before;
    for (int k = 0; k < 4; ++k) levels[k] = before[k] = state_.map()[voxels[k]];
    std::sort(levels.begin(), levels.end());
    if (levels.front() == levels.back()) return 0;
    const auto arrange = [&](const std::array<std::uint8_t, 4>& to) {
      double change = 0.0;
      for (int k = 0; k < 4; ++k) change += state_.change(voxels[k], to[k]);
      return change;
    };
    std::array<std::array<std::uint8_t, 4>, 24> arrangements;
    std::array<double, 24> log_weights;
    int count = 0;
    double log_likelihood = 0.0;
    do {
      log_likelihood += arrange(levels);
      arrangements[count] = levels;
      log_weights[count++] = log_likelihood;
    } while (std::next_permutation(levels.begin(), levels.end()));
    const double largest = *std::max_element(log_weights.begin(), log_weights.begin() + count);
    double total = 0.0;
    for (int k = 0; k < count; ++k) total += log_weights[k] = std::exp(log_weights[k] - largest);
    int chosen = 0;
    for (double at = u * total; chosen < count - 1 && at > log_weights[chosen]; ++chosen) at -= log_weights[chosen];
    arrange(arrangements[chosen]);
    std::size_t changed = 0;
    for (int k = 0; k < 4; ++k) changed += before[k] != arrangements[chosen][k];
    return changed;
  }

  /// The voxel after this one along an axis, if it is one that moves may touch.
  bool neighbour(std::uint32_t voxel, int axis, std::uint32_t& next) const {
    if (grid_.cell(voxel)[axis] + 1 >= grid_.size[axis]) return false;
    next = voxel + stride_[axis];
    return sites_.kind[next] == Sites::near;
  }

  const VoxelGrid& grid_;
  const Sites& sites_;
  State& state_;
  std::array<std::uint32_t, 3> stride_;
};

}  // namespace nextview
