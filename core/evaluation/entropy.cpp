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

/// Two sums over bricks.
struct Sums {
  double entropy = 0.0;  ///< [nats]
  std::size_t voxels = 0;

  Sums operator+(const Sums& other) const { return {entropy + other.entropy, voxels + other.voxels}; }
};

/// The sum of `term(brick, memory)` over bricks. Split and joined in the same places on any number of threads, so that
/// it rounds alike.
template <class Term>
Sums sum(std::size_t bricks, Term term) {
  constexpr std::size_t at_once = 64;
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, bricks, at_once), Sums(),
      [&](const auto& range, Sums part) {
        BrickMemory<Sums> memory;
        for (std::size_t b = range.begin(); b != range.end(); ++b) part = part + term(b, memory);
        return part;
      },
      std::plus<>());
}

/// What a brick's voxels are known better than if nothing were, and how many are measured.
Sums known(const Brick& brick) {
  BrickBeliefs is(brick);
  Sums known{0.0, brick.measured_count()};
  for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) known.entropy += double(Voxel().entropy) - is.entropy(i);
  return known;
}

Sums change(const Brick& before, const Brick& after) {
  BrickBeliefs was(before), is(after);
  Sums change;
  for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i) {
    change.entropy += double(was.entropy(i)) - double(is.entropy(i));
    change.voxels += after.measured(i) && !before.measured(i);
  }
  return change;
}

void require_same_size(const VoxelBricks& before, const VoxelBricks& after) {
  if (before.edges() != after.edges())
    throw std::invalid_argument(
        fmt::format("maps to be compared: one has {} voxels, the other {}", before.size(), after.size()));
}

}  // namespace

MapEntropy map_entropy(const VoxelBricks& voxels) {
  // Where bricks stick out of the grid their voxels are as uncertain as they can be.
  const Sums known_of_all = sum(voxels.brick_count(), [&](std::size_t b, BrickMemory<Sums>& memory) {
    if (voxels.is_untouched(b)) return Sums();
    const Brick& brick = *voxels.bricks()[b];
    return memory.of(brick, [&] { return known(brick); });
  });
  const double most = double(voxels.size()) * double(Voxel().entropy);
  return {double(voxels.size()) - double(known_of_all.voxels), (most - known_of_all.entropy) / std::numbers::ln2};
}

MapChange map_change(const VoxelBricks& before, const VoxelBricks& after) {
  require_same_size(before, after);
  const Sums all = sum(before.brick_count(), [&](std::size_t b, BrickMemory<Sums>& memory) {
    const auto &was = before.bricks()[b], &is = after.bricks()[b];
    return was.shares_with(is) ? Sums() : memory.of(*was, *is, [&] { return change(*was, *is); });
  });
  return {all.voxels, all.entropy};
}

std::size_t differing_classes(const VoxelBricks& one, const VoxelBricks& other) {
  require_same_size(one, other);
  const auto differing = [&](std::size_t b, BrickMemory<Sums>&) {
    const Brick &here = *one.bricks()[b], &there = *other.bricks()[b];
    Sums sums;
    one.for_each_row(b, [&](std::size_t first, const Eigen::Vector3i&, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) sums.voxels += here.voxel_class(i) != there.voxel_class(i);
    });
    return sums;
  };
  return sum(one.brick_count(), differing).voxels;
}

}  // namespace nextview
