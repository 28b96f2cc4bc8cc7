#pragma once
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"

namespace nextview {

/// The full Bayesian solution (Eqs. 3-4): the probability of every map, added up per voxel.
struct ExactPosterior {
  std::vector<double> occupied;  ///< P(level > 0 | z) of each voxel of the grid
  std::vector<double> upper;     ///< P(uppermost level | z)
  std::vector<double> reach;     ///< measured rays that reach each voxel, on posterior average
  double log_evidence = 0.0;     ///< log p(z)
};

/// Enumerates all maps of the grid: levels^voxels of them, at most 2^20.
/// `prior`: of a voxel being at any level but 0; the levels share it evenly.
/// @throws std::invalid_argument if there are more maps than that, or a parameter is out of bounds.
ExactPosterior exact_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                               const ForwardSensorModel& model, double prior);

}  // namespace nextview
