#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/evaluation/truth_convention.hpp"
#include "core/map/bit_mask.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// The voxels that a score is over; named with every score. Hidden voxels are in none of them.
enum class ScoredSet {
  visited,      ///< a noise-free ray visits it (the caller's mask)
  region,       ///< all of the region of interest
  band,         ///< at most `band_width` voxels from one that the surface touches (Chebyshev)
  visited_band  ///< both: visited, and in the band
};

constexpr std::string_view name(ScoredSet set) {
  constexpr std::array<std::string_view, 4> names = {"visited", "region", "band", "visited band"};
  return names[static_cast<std::size_t>(set)];
}

/// Where the probability is clamped in the log loss, to [1e-3, 1 - 1e-3], and the truth in D_KL: 0 and 1 would make
/// either infinite.
constexpr double probability_floor = 1e-3;

struct ReliabilityBin {
  std::size_t voxels = 0;
  double mean_probability = 0.0;  ///< what the map says; 0 if the bin is empty
  double occupied_share = 0.0;    ///< what is true; 0 if the bin is empty
};

/// How well a map's probabilities agree with the truth, over a scored set. Of an empty set all scores are 0.
struct MapQuality {
  std::size_t voxels = 0;
  double log_loss = 0.0;                 ///< mean of -ln of what the map gave to the truth, p clamped [nats per voxel]
  double brier = 0.0;                    ///< mean of (p - truth)^2
  double divergence = 0.0;               ///< D_KL(p || q), Eqs. 15-16: p as it is, q the clamped truth; a sum [nats]
  double divergence_outside_band = 0.0;  ///< share of it that lies outside the band; 0 if there is none
  /// Expected calibration error: mean of |occupied share - mean p| over the bins, weighted by their voxels.
  double calibration_error = 0.0;
  std::array<ReliabilityBin, 10> reliability;  ///< by p: [0, 0.1), ..., [0.9, 1]
};

/// `probabilities`: one per voxel of the truth's grid. `visited`: likewise, 1 where visited; only the sets named after
/// it need it.
/// @throws std::invalid_argument if lengths differ.
MapQuality map_quality(std::span<const float> probabilities, const GroundTruth& truth, TruthConvention convention,
                       ScoredSet set, std::span<const std::uint8_t> visited = {});
/// The same over several sets in one pass, in their order.
std::vector<MapQuality> map_quality(std::span<const float> probabilities, const GroundTruth& truth,
                                    TruthConvention convention, std::span<const ScoredSet> sets,
                                    std::span<const std::uint8_t> visited = {});
/// The same of a map's voxels as they are kept.
std::vector<MapQuality> map_quality(const VoxelBricks& voxels, const GroundTruth& truth, TruthConvention convention,
                                    std::span<const ScoredSet> sets, const BitMask& visited);

}  // namespace nextview
