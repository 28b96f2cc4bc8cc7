#include "core/evaluation/map_quality.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nextview {
namespace {

struct Sums {
  std::size_t voxels = 0;
  double log_loss = 0.0, brier = 0.0, divergence = 0.0, divergence_outside = 0.0;
  struct Bin {
    std::size_t voxels = 0, occupied = 0;
    double probability = 0.0;
  };
  std::array<Bin, 10> bins;

  void add(double p, bool occupied, bool in_band) {
    ++voxels;
    const double clamped = std::clamp(p, probability_floor, 1.0 - probability_floor);
    log_loss -= std::log(occupied ? clamped : 1.0 - clamped);
    brier += (p - occupied) * (p - occupied);

    const double q = occupied ? 1.0 - probability_floor : probability_floor;
    const double term =
        (p > 0.0 ? p * std::log(p / q) : 0.0) + (p < 1.0 ? (1.0 - p) * std::log((1.0 - p) / (1.0 - q)) : 0.0);
    divergence += term;  // Eqs. 15 and 16
    if (!in_band) divergence_outside += term;

    Bin& bin = bins[std::min<std::size_t>(9, static_cast<std::size_t>(p * 10.0))];
    ++bin.voxels;
    bin.occupied += occupied;
    bin.probability += p;
  }

  Sums& operator+=(const Sums& other) {
    voxels += other.voxels;
    log_loss += other.log_loss;
    brier += other.brier;
    divergence += other.divergence;
    divergence_outside += other.divergence_outside;
    for (std::size_t b = 0; b < bins.size(); ++b) {
      bins[b].voxels += other.bins[b].voxels;
      bins[b].occupied += other.bins[b].occupied;
      bins[b].probability += other.bins[b].probability;
    }
    return *this;
  }
};

MapQuality means(const Sums& sums) {
  MapQuality quality;
  quality.voxels = sums.voxels;
  quality.divergence = sums.divergence;
  if (sums.divergence > 0.0) quality.divergence_outside_band = sums.divergence_outside / sums.divergence;
  if (sums.voxels == 0) return quality;
  const double n = static_cast<double>(sums.voxels);
  quality.log_loss = sums.log_loss / n;
  quality.brier = sums.brier / n;
  for (std::size_t b = 0; b < sums.bins.size(); ++b) {
    const auto& bin = sums.bins[b];
    if (bin.voxels == 0) continue;
    const double in_bin = static_cast<double>(bin.voxels);
    quality.reliability[b] = {bin.voxels, bin.probability / in_bin, double(bin.occupied) / in_bin};
    quality.calibration_error += std::abs(bin.probability - double(bin.occupied)) / n;
  }
  return quality;
}

void check_lengths(std::size_t probabilities, const GroundTruth& truth, ScoredSet set, std::size_t visited) {
  const std::size_t voxels = truth.grid.voxel_count();
  if (probabilities != voxels)
    throw std::invalid_argument(
        fmt::format("map quality: {} probabilities for {} voxels of truth", probabilities, voxels));
  const bool needs_visited = set == ScoredSet::visited || set == ScoredSet::visited_band;
  if (needs_visited && visited != voxels)
    throw std::invalid_argument(fmt::format(
        "map quality: the scored set '{}' needs a mask of {} visited voxels, not of {}", name(set), voxels, visited));
}

}  // namespace

MapQuality map_quality(std::span<const float> probabilities, const GroundTruth& truth, TruthConvention convention,
                       ScoredSet set, std::span<const std::uint8_t> visited) {
  check_lengths(probabilities.size(), truth, set, visited.size());
  const bool only_visited = set == ScoredSet::visited || set == ScoredSet::visited_band;
  const bool only_band = set == ScoredSet::band || set == ScoredSet::visited_band;
  // Split and joined in the same places on any number of threads, so that the sums round alike.
  const Sums sums = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, probabilities.size(), 1 << 15), Sums(),
      [&](const auto& range, Sums part) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const bool in_band = truth.surface_distance[i] <= band_width;
          if ((only_visited && !visited[i]) || (only_band && !in_band)) continue;
          const VoxelTruth voxel = voxel_truth(truth, i, convention);
          if (voxel != VoxelTruth::hidden) part.add(probabilities[i], voxel == VoxelTruth::occupied, in_band);
        }
        return part;
      },
      [](Sums a, const Sums& b) { return a += b; });
  return means(sums);
}

}  // namespace nextview
