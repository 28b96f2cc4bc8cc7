#include "core/evaluation/quality_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nextview {
namespace {

QualityTerms terms_of(double p, bool occupied) {
  const double clamped = std::clamp(p, probability_floor, 1.0 - probability_floor);
  const double q = occupied ? 1.0 - probability_floor : probability_floor;
  return {-std::log(occupied ? clamped : 1.0 - clamped), (p - occupied) * (p - occupied),
          (p > 0.0 ? p * std::log(p / q) : 0.0) +
              (p < 1.0 ? (1.0 - p) * std::log((1.0 - p) / (1.0 - q)) : 0.0),  // Eqs. 15 and 16
          std::min<std::size_t>(9, static_cast<std::size_t>(p * 10.0))};
}

bool counts(ScoredSet set, VoxelFacts facts) {
  const bool of_visited = set == ScoredSet::visited || set == ScoredSet::visited_band;
  const bool of_band = set == ScoredSet::band || set == ScoredSet::visited_band;
  return (!of_visited || facts & is_visited) && (!of_band || facts & is_in_band);
}

}  // namespace

void QualitySums::add(double p, VoxelFacts facts, const QualityTerms& terms, std::size_t count) {
  const double n = static_cast<double>(count);
  voxels += count;
  log_loss += n * terms.log_loss;
  brier += n * terms.brier;
  divergence += n * terms.divergence;
  if (!(facts & is_in_band)) divergence_outside += n * terms.divergence;
  Bin& bin = bins[terms.bin];
  bin.voxels += count;
  bin.occupied += facts & is_occupied ? count : 0;
  bin.probability += n * p;
}

QualitySums& QualitySums::operator+=(const QualitySums& other) {
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

MapQuality QualitySums::quality() const {
  MapQuality quality;
  quality.voxels = voxels;
  quality.divergence = divergence;
  if (divergence > 0.0) quality.divergence_outside_band = divergence_outside / divergence;
  if (voxels == 0) return quality;
  const double n = static_cast<double>(voxels);
  quality.log_loss = log_loss / n;
  quality.brier = brier / n;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    const Bin& bin = bins[b];
    if (bin.voxels == 0) continue;
    const double in_bin = static_cast<double>(bin.voxels);
    quality.reliability[b] = {bin.voxels, bin.probability / in_bin, double(bin.occupied) / in_bin};
    quality.calibration_error += std::abs(bin.probability - double(bin.occupied)) / n;
  }
  return quality;
}

QualitySumsOfSets::QualitySumsOfSets(std::span<const ScoredSet> sets) {
  for (VoxelFacts facts = 0; facts < all_facts; ++facts)
    for (const ScoredSet set : sets)
      if (nextview::counts(set, facts)) counted_in_[facts] |= 1u << static_cast<unsigned>(set);
}

void QualitySumsOfSets::add(double p, VoxelFacts facts, const QualityTerms& terms, std::size_t count) {
  for (unsigned sets = counted_in_[facts]; sets != 0; sets &= sets - 1)
    sums_[static_cast<std::size_t>(std::countr_zero(sets))].add(p, facts, terms, count);
}

QualitySumsOfSets& QualitySumsOfSets::operator+=(const QualitySumsOfSets& other) {
  for (std::size_t s = 0; s < sums_.size(); ++s) sums_[s] += other.sums_[s];
  return *this;
}

AlikeVoxels::~AlikeVoxels() {
  for (std::size_t i = 0; i < counts_.size(); ++i) flush(counts_[i], static_cast<VoxelFacts>(i % all_facts));
}

void AlikeVoxels::flush(Count& count, VoxelFacts facts) {
  if (count.voxels > 0) sums_.add(count.p, facts, terms_of(count.p, facts & is_occupied), count.voxels);
  count.voxels = 0;
}

}  // namespace nextview
