#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"

namespace nextview {

/// What one ray says of a voxel.
struct RayEvidence {
  std::uint32_t ray = 0;           ///< of RangeMeasurements::rays
  double enter = 0.0, exit = 0.0;  ///< of the voxel, distances from the camera [m]
  /// weight independence (log p(z | m, level) - log p(z | m, free)), level being FullConditional::level: positive where
  /// the ray speaks for the voxel being at that level.
  double log_ratio = 0.0;
};

/// The full conditional of one voxel given all others (Eqs. 6-9), taken apart: what the exact sampler draws from.
/// log(probability[level] / probability[0]) = log_prior_odds + the sum of the rays' log_ratio.
struct FullConditional {
  std::vector<double> probability;  ///< of each level; they sum to 1
  int level = 1;                    ///< the likeliest but free: what the evidence is for. Ties go to the lower
  double log_prior_odds = 0.0;      ///< of a level that is not free
  std::vector<RayEvidence> rays;    ///< all that depend on the voxel, in the order of the measurements
};

/// By the definition, log_likelihood(): no state, no lists. `levels`: the whole map, one entry a voxel of the grid;
/// what it has at the voxel itself does not matter. `prior`: of being at any level but free; the levels share it
/// evenly.
/// @throws std::invalid_argument if the model or the prior is out of bounds, or the map or the voxel is of another grid
/// or model.
FullConditional full_conditional(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                 const ForwardSensorModel& model, double prior, std::span<const std::uint8_t> levels,
                                 std::uint32_t voxel);

}  // namespace nextview
