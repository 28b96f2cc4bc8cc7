#pragma once
#include <cmath>
#include <cstdint>

namespace nextview {

inline double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }
inline double probability(double log_odds) { return 1.0 - 1.0 / (1.0 + std::exp(log_odds)); }

/// Entropy of a binary voxel [nats] (Eq. 11).
inline double entropy(double p) {
  return p <= 0.0 || p >= 1.0 ? 0.0 : -p * std::log(p) - (1.0 - p) * std::log(1.0 - p);
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
      0;  ///< how far behind a measured surface it lies [voxels along the ray]; 0: not behind one
};

/// OctoMap's inverse sensor model and the bounds of the classes (SCIENCE: the conventional map).
struct InverseSensorModel {
  double hit = 0.7;         ///< probability that a voxel is occupied given that a ray ended in it
  double miss = 0.4;        ///< ... given that a ray passed through it
  double clamp_min = 0.12;  ///< bounds of the probability
  double clamp_max = 0.97;
  double occupancy_threshold = 0.5;  ///< from here on a measured voxel stops a ray
  double free_below = 0.2;           ///< class free: p < this
  double occupied_above = 0.8;       ///< class occupied: p > this; between the two: unknown

  bool operator==(const InverseSensorModel&) const = default;
  /// @throws std::invalid_argument naming the field and its bounds.
  void validate() const;

  VoxelClass classify(double p) const {
    return p > occupied_above ? VoxelClass::occupied : p < free_below ? VoxelClass::free : VoxelClass::unknown;
  }
};

}  // namespace nextview
