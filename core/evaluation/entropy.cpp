#include "core/evaluation/entropy.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <numbers>
#include <stdexcept>

#include "core/map/brick_memory.hpp"

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

/// The sum of `term(brick, memory)` over bricks. Split and joined in the same places on any number of threads, so that
/// it rounds alike.
template <class Term>
double sum(std::size_t bricks, Term term) {
  constexpr std::size_t at_once = 64;
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, bricks, at_once), 0.0,
      [&](const auto& range, double part) {
        BrickMemory<double> memory;
        for (std::size_t b = range.begin(); b != range.end(); ++b) part += term(b, memory);
        return part;
      },
      std::plus<>());
}

double measured_count(const VoxelBricks& voxels) {
  return sum(voxels.brick_count(), [&](std::size_t b, BrickMemory<double>& memory) {
    const Brick& brick = *voxels.bricks()[b];
    return memory.of(brick, [&] { return double(brick.measured_count()); });
  });
}

/// Entropies of a brick's voxels, asked for one after the other: many are as the one before.
class Entropies {
 public:
  explicit Entropies(const Brick& brick) : brick_(brick) {}
  double operator()(std::size_t i) {
    if (!brick_.follows_from_log_odds()) return brick_.entropy(i);
    if (const float log_odds = brick_.log_odds(i); log_odds != last_) last_ = log_odds, entropy_ = brick_.entropy(i);
    return entropy_;
  }

 private:
  const Brick& brick_;
  float last_ = 0.0f, entropy_ = Voxel().entropy;
};

double entropy_change(const Brick& before, const Brick& after) {
  Entropies was(before), is(after);
  double change = 0.0;
  for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) change += was(i) - is(i);
  return change;
}

}  // namespace

double unmeasured_entropy(const VoxelBricks& voxels) {  // Eq. 18
  return double(voxels.size()) - measured_count(voxels);
}

double total_entropy(const VoxelBricks& voxels) {
  // Where bricks stick out of the grid their voxels are as uncertain as they can be.
  const double most = double(Voxel().entropy);
  const double known = sum(voxels.brick_count(), [&](std::size_t b, BrickMemory<double>& memory) {
    if (voxels.is_untouched(b)) return 0.0;
    const Brick& brick = *voxels.bricks()[b];
    return memory.of(brick, [&] {
      Entropies is(brick);
      double change = 0.0;
      for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) change += most - is(i);
      return change;
    });
  });
  return (double(voxels.size()) * most - known) / std::numbers::ln2;
}

double realised_gain(const VoxelBricks& before, const VoxelBricks& after) {  // Eq. 12
  if (before.edges() != after.edges())
    throw std::invalid_argument(fmt::format("realised gain: {} voxels before, {} after", before.size(), after.size()));
  return sum(before.brick_count(), [&](std::size_t b, BrickMemory<double>& memory) {
    const auto &was = before.bricks()[b], &is = after.bricks()[b];
    return was.shares_with(is) ? 0.0 : memory.of(*was, *is, [&] { return entropy_change(*was, *is); });
  });
}

}  // namespace nextview
