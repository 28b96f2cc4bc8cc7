#include "core/evaluation/entropy.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <numbers>
#include <stdexcept>

namespace nextview {
namespace {

/// Split and joined in the same places on any number of threads, so that the sum rounds alike.
template <class Term>
double sum(std::size_t count, Term term) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, 1 << 15), 0.0,
      [&](const auto& range, double part) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) part += term(i);
        return part;
      },
      std::plus<>());
}

}  // namespace

double unmeasured_entropy(std::span<const Voxel> voxels) {  // Eq. 18
  return sum(voxels.size(), [&](std::size_t i) { return voxels[i].measured ? 0.0 : 1.0; });
}

double total_entropy(std::span<const Voxel> voxels) {
  return sum(voxels.size(), [&](std::size_t i) { return double(voxels[i].entropy); }) / std::numbers::ln2;
}

double realised_gain(std::span<const Voxel> before, std::span<const Voxel> after,
                     std::span<const std::uint8_t> mask) {  // Eq. 12
  if (before.size() != after.size() || (!mask.empty() && mask.size() != before.size()))
    throw std::invalid_argument(fmt::format("realised gain: {} voxels before, {} after, {} in the mask", before.size(),
                                            after.size(), mask.size()));
  return sum(before.size(), [&](std::size_t i) {
    return mask.empty() || mask[i] ? double(before[i].entropy) - double(after[i].entropy) : 0.0;
  });
}

}  // namespace nextview
