#include "core/evaluation/entropy.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <numbers>
#include <stdexcept>

namespace nextview {
namespace {

/// The sum of `term(first, last)` over parts of `count` voxels. Split and joined in the same places on any number of
/// threads, so that it rounds alike.
template <class Term>
double sum_of_parts(std::size_t count, Term term) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, 1 << 15), 0.0,
      [&](const auto& range, double part) { return term(range.begin(), range.end(), part); }, std::plus<>());
}

/// The sum of a term of each voxel.
template <class Term>
double sum(const VoxelBricks& voxels, Term term) {
  return sum_of_parts(voxels.size(), [&](std::size_t first, std::size_t last, double part) {
    auto voxel = voxels.from(first);
    for (std::size_t i = first; i != last; ++i, ++voxel) part += term(*voxel);
    return part;
  });
}

}  // namespace

double unmeasured_entropy(const VoxelBricks& voxels) {  // Eq. 18
  return sum(voxels, [](const Voxel& voxel) { return voxel.measured ? 0.0 : 1.0; });
}

double total_entropy(const VoxelBricks& voxels) {
  return sum(voxels, [](const Voxel& voxel) { return double(voxel.entropy); }) / std::numbers::ln2;
}

double realised_gain(const VoxelBricks& before, const VoxelBricks& after,
                     std::span<const std::uint8_t> mask) {  // Eq. 12
  if (before.size() != after.size() || (!mask.empty() && mask.size() != before.size()))
    throw std::invalid_argument(fmt::format("realised gain: {} voxels before, {} after, {} in the mask", before.size(),
                                            after.size(), mask.size()));
  return sum_of_parts(before.size(), [&](std::size_t first, std::size_t last, double part) {
    auto was = before.from(first), is = after.from(first);
    for (std::size_t i = first; i != last; ++i, ++was, ++is)
      if (mask.empty() || mask[i]) part += double(was->entropy) - double(is->entropy);
    return part;
  });
}

}  // namespace nextview
