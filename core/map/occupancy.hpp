#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/setting/setting.hpp"

namespace nextview {

inline double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }
inline double probability(double log_odds) { return 1.0 - 1.0 / (1.0 + std::exp(log_odds)); }

/// Entropy of a binary voxel [nats] (Eq. 11).
inline double entropy(double p) {
  return p <= 0.0 || p >= 1.0 ? 0.0 : -p * std::log(p) - (1.0 - p) * std::log(1.0 - p);
}

/// What log-odds say.
struct Belief {
  float log_odds = 0.0f;
  float entropy = 0.6931472f;  ///< [nats]
  double probability = 0.5;    ///< of being occupied
};

/// A map has few different log-odds, and logarithms are expensive: each thread remembers those that it met last.
inline const Belief& belief(float log_odds) {
  constexpr int places = 8;  // as a power of 2
  constinit thread_local std::array<Belief, 1 << places> remembered{};
  Belief& b = remembered[std::bit_cast<std::uint32_t>(log_odds) * 2654435769u >> (32 - places)];
  if (b.log_odds != log_odds) {
    const double p = probability(log_odds);
    b = {log_odds, static_cast<float>(entropy(p)), p};
  }
  return b;
}

/// The three classes of the gains; see InverseSensorModel for their bounds.
enum class VoxelClass : std::uint8_t { unknown, free, occupied };

/// What gains and pictures see of a voxel. Made by the occupancy map, or by any other map that has probabilities.
struct Voxel {
  float probability = 0.5f;    ///< of being occupied
  float entropy = 0.6931472f;  ///< [nats]
  VoxelClass voxel_class = VoxelClass::unknown;
  bool measured = false;  ///< a measurement has touched it (a Gibbs map: it is informed)
  std::uint16_t occlusion_distance =
      0;                  ///< unmeasured: how far behind a surface it lies [voxels along the ray]; 0: not behind one
  float log_odds = 0.0f;  ///< of `probability`, as the occupancy map adds them up; 0 in other maps
};

/// Of voxels in the grid's order.
template <class Voxels>
std::vector<float> probabilities(const Voxels& voxels) {
  std::vector<float> result;
  result.reserve(voxels.size());
  for (const Voxel& voxel : voxels) result.push_back(voxel.probability);
  return result;
}

/// How large an update term is at `range` [m] from the camera, as a share of what it is at 1 m; `decay` in 1/m. The
/// exponent is kept within 80, so that in single precision too a term neither overflows nor vanishes.
inline double range_factor(double decay, double range) {
  return std::exp(std::clamp(-decay * (range - 1.0), -80.0, 80.0));
}

/// OctoMap's inverse sensor model and the bounds of the classes. OctoMap's terms do not depend on the range; with
/// decays they do.
struct InverseSensorModel {
  double hit = 0.7;         ///< probability that a voxel is occupied given that a ray ended in it, 1 m away
  double miss = 0.4;        ///< ... given that a ray passed through it
  double hit_decay = 0.0;   ///< the log-odds of a hit fall by this share per metre, as exp(-decay (range - 1 m)) [1/m]
  double miss_decay = 0.0;  ///< ... of a miss
  double clamp_min = 0.12;  ///< bounds of the probability
  double clamp_max = 0.97;
  double occupancy_threshold = 0.5;  ///< from here on a measured voxel stops a ray
  double free_below = 0.2;           ///< class free: p < this
  double occupied_above = 0.8;       ///< class occupied: p > this; between the two: unknown

  bool operator==(const InverseSensorModel&) const = default;
  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;

  bool range_dependent() const { return hit_decay != 0.0 || miss_decay != 0.0; }
  /// What a hit adds to the log-odds of a voxel whose centre is `range` [m] from the camera.
  double hit_term(double range) const { return log_odds(hit) * range_factor(hit_decay, range); }
  /// ... and a miss; negative.
  double miss_term(double range) const { return log_odds(miss) * range_factor(miss_decay, range); }

  VoxelClass classify(double p) const {
    return p > occupied_above ? VoxelClass::occupied : p < free_below ? VoxelClass::free : VoxelClass::unknown;
  }
};
std::vector<Setting> settings(InverseSensorModel& model);

}  // namespace nextview
