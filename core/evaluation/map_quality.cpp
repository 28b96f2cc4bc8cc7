#include "core/evaluation/map_quality.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/evaluation/repeated_sum.hpp"

namespace nextview {
namespace {

/// What a voxel adds to the sums.
struct Terms {
  double log_loss, brier, divergence;
  std::size_t bin;
};

Terms terms_of(double p, bool occupied) {
  const double clamped = std::clamp(p, probability_floor, 1.0 - probability_floor);
  const double q = occupied ? 1.0 - probability_floor : probability_floor;
  return {-std::log(occupied ? clamped : 1.0 - clamped), (p - occupied) * (p - occupied),
          (p > 0.0 ? p * std::log(p / q) : 0.0) +
              (p < 1.0 ? (1.0 - p) * std::log((1.0 - p) / (1.0 - q)) : 0.0),  // Eqs. 15 and 16
          std::min<std::size_t>(9, static_cast<std::size_t>(p * 10.0))};
}

/// Voxels often have the same probability, and logarithms are expensive.
class KnownTerms {
 public:
  const Terms& of(float p, bool occupied) {
    Known& known = known_[(std::bit_cast<std::uint32_t>(p) * 0x9e3779b1u >> 25) * 2 + occupied];
    if (known.p != p) known = {p, terms_of(p, occupied)};
    return known.terms;
  }

 private:
  struct Known {
    float p = -1.0f;
    Terms terms{};
  };
  std::array<Known, 256> known_{};
};

struct Sums {
  std::size_t voxels = 0;
  double log_loss = 0.0, brier = 0.0, divergence = 0.0, divergence_outside = 0.0;
  struct Bin {
    std::size_t voxels = 0, occupied = 0;
    double probability = 0.0;
  };
  std::array<Bin, 10> bins;

  /// So many voxels, as if one by one.
  void add(double p, bool occupied, bool in_band, const Terms& terms, std::size_t count) {
    voxels += count;
    add_times(log_loss, terms.log_loss, count);
    add_times(brier, terms.brier, count);
    add_times(divergence, terms.divergence, count);
    if (!in_band) add_times(divergence_outside, terms.divergence, count);
    Bin& bin = bins[terms.bin];
    bin.voxels += count;
    bin.occupied += occupied ? count : 0;
    add_times(bin.probability, p, count);
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

constexpr std::size_t scored_sets = 4;
bool of_visited(ScoredSet set) { return set == ScoredSet::visited || set == ScoredSet::visited_band; }
bool of_band(ScoredSet set) { return set == ScoredSet::band || set == ScoredSet::visited_band; }

/// Which of the sets that are scored a voxel belongs to, a bit each.
class SetsOfVoxel {
 public:
  explicit SetsOfVoxel(std::span<const ScoredSet> sets) {
    for (const bool in_band : {false, true})
      for (const bool visited : {false, true})
        for (const ScoredSet set : sets)
          if ((visited || !of_visited(set)) && (in_band || !of_band(set)))
            sets_[2 * in_band + visited] |= 1u << static_cast<unsigned>(set);
  }
  unsigned operator()(bool in_band, bool visited) const { return sets_[2 * in_band + visited]; }

 private:
  std::array<unsigned, 4> sets_{};
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
  if (of_visited(set) && visited != voxels)
    throw std::invalid_argument(fmt::format(
        "map quality: the scored set '{}' needs a mask of {} visited voxels, not of {}", name(set), voxels, visited));
}

using SumsOfSets = std::array<Sums, scored_sets>;

/// Adds voxels to the sums of the sets that they count in. In free space many in a row are alike.
class RunsOfVoxels {
 public:
  explicit RunsOfVoxels(SumsOfSets& sums) : sums_(sums) {}
  ~RunsOfVoxels() { end(); }
  RunsOfVoxels(const RunsOfVoxels&) = delete;

  void add(float p, bool occupied, bool in_band, unsigned counts_in, std::size_t count) {
    if (p != p_ || occupied != occupied_ || in_band != in_band_ || counts_in != counts_in_) {
      end();
      p_ = p, occupied_ = occupied, in_band_ = in_band, counts_in_ = counts_in;
    }
    count_ += count;
  }

 private:
  void end() {
    if (count_ == 0) return;
    const Terms& terms = known_.of(p_, occupied_);
    for (unsigned sets = counts_in_; sets != 0; sets &= sets - 1)
      sums_[std::countr_zero(sets)].add(p_, occupied_, in_band_, terms, count_);
    count_ = 0;
  }

  SumsOfSets& sums_;
  KnownTerms known_;
  float p_ = 0.0f;
  bool occupied_ = false, in_band_ = false;
  unsigned counts_in_ = 0;
  std::size_t count_ = 0;
};

/// 64 of a mask's flags from one on, the lowest bit first; beyond its end 0.
std::uint64_t bits_from(const BitMask& mask, std::size_t first) {
  const std::vector<std::uint64_t>& words = mask.words();
  const std::size_t word = first / 64, shift = first % 64;
  return words[word] >> shift | (shift != 0 && word + 1 < words.size() ? words[word + 1] << (64 - shift) : 0);
}

/// What is true of a voxel, and of how many from it on.
struct VoxelRun {
  VoxelTruth truth;
  bool in_band, visited;
  std::size_t count;
};
VoxelRun run_from(const GroundTruth& truth, TruthConvention convention, const BitMask* visited, std::size_t first) {
  const std::uint64_t touch = bits_from(truth.touch, first), centre = bits_from(truth.centre, first);
  const std::uint64_t band = bits_from(truth.near_surface, first), seen = visited ? bits_from(*visited, first) : 0;
  const auto changes = [](std::uint64_t bits) { return bits ^ (0 - (bits & 1)); };
  const int alike = std::countr_zero(changes(touch) | changes(centre) | changes(band) | changes(seen));
  return {voxel_truth(truth, first, convention), (band & 1) != 0, (seen & 1) != 0, std::size_t(alike)};
}

/// `from(i)`: where the probabilities of a voxel and the next ones are; `next(most)` gives one, and of how many from
/// there on it is, and `skip(count)` goes on. `visited` may be null where no set needs it.
template <class From>
std::vector<MapQuality> qualities(const GroundTruth& truth, TruthConvention convention, std::span<const ScoredSet> sets,
                                  From from, const BitMask* visited) {
  const SetsOfVoxel sets_of(sets);
  // Split and joined in the same places on any number of threads, so that the sums round alike.
  const SumsOfSets all = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, truth.grid.voxel_count(), 1 << 15), SumsOfSets(),
      [&](const auto& range, SumsOfSets part) {
        {
          RunsOfVoxels runs(part);
          auto probabilities = from(range.begin());
          for (std::size_t i = range.begin(), left = 0; i != range.end(); i += left) {
            const VoxelRun run = run_from(truth, convention, visited, i);
            left = std::min(run.count, range.end() - i);
            const unsigned counts_in = run.truth == VoxelTruth::hidden ? 0 : sets_of(run.in_band, run.visited);
            if (counts_in == 0) probabilities.skip(left);
            for (std::size_t done = 0; counts_in != 0 && done < left;) {
              const auto [probability, count] = probabilities.next(left - done);
              runs.add(probability, run.truth == VoxelTruth::occupied, run.in_band, counts_in, count);
              done += count;
            }
          }
        }
        return part;
      },
      [](SumsOfSets a, const SumsOfSets& b) {
        for (std::size_t s = 0; s < a.size(); ++s) a[s] += b[s];
        return a;
      });
  std::vector<MapQuality> result;
  for (const ScoredSet set : sets) result.push_back(means(all[static_cast<std::size_t>(set)]));
  return result;
}

struct Probabilities {
  const float* at;

  std::pair<float, std::size_t> next(std::size_t) { return {*at++, 1}; }
  void skip(std::size_t count) { at += count; }
};

struct ProbabilitiesOfVoxels {
  VoxelBricks::Iterator voxel;

  std::pair<float, std::size_t> next(std::size_t most) {
    const std::pair found((*voxel).probability, voxel.alike(most));
    voxel += found.second;
    return found;
  }
  void skip(std::size_t count) { voxel += count; }
};

}  // namespace

std::vector<MapQuality> map_quality(std::span<const float> probabilities, const GroundTruth& truth,
                                    TruthConvention convention, std::span<const ScoredSet> sets,
                                    std::span<const std::uint8_t> visited) {
  for (const ScoredSet set : sets) check_lengths(probabilities.size(), truth, set, visited.size());
  const BitMask mask(visited);
  return qualities(
      truth, convention, sets, [&](std::size_t i) { return Probabilities{probabilities.data() + i}; },
      std::ranges::any_of(sets, of_visited) ? &mask : nullptr);
}

std::vector<MapQuality> map_quality(const VoxelBricks& voxels, const GroundTruth& truth, TruthConvention convention,
                                    std::span<const ScoredSet> sets, const BitMask& visited) {
  for (const ScoredSet set : sets) check_lengths(voxels.size(), truth, set, visited.size());
  return qualities(
      truth, convention, sets, [&](std::size_t i) { return ProbabilitiesOfVoxels{voxels.from(i)}; },
      std::ranges::any_of(sets, of_visited) ? &visited : nullptr);
}

MapQuality map_quality(std::span<const float> probabilities, const GroundTruth& truth, TruthConvention convention,
                       ScoredSet set, std::span<const std::uint8_t> visited) {
  return map_quality(probabilities, truth, convention, std::span(&set, 1), visited).front();
}

}  // namespace nextview
