#pragma once
#include <string>
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"
#include "core/gibbs/range_measurements.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview::random_problems {

/// What a test problem is made from. Lengths count in voxel edges.
struct Shape {
  std::string name;
  Eigen::Vector3i size = {10, 1, 1};
  int origins = 1;
  int rays = 6;
  double sigma = 0.5;    ///< noise of the ranges
  bool weights = false;  ///< rays that stand for several
};

/// A grid and rays through a random map: hits with noise, misses, outliers. The same seed, the same test problem.
struct Problem {
  VoxelGrid grid;
  RangeMeasurements measurements;
  double sigma = 0.0;  ///< [m]
};
Problem make(const Shape& shape, std::uint64_t seed);

/// 400 voxels: more than the test problems below, so that threads have something to share.
Problem room();

/// A model of this kind that knows the noise of the problem, with more outliers than by default.
ForwardSensorModel model_for(const Problem& problem, ForwardModel kind, VoxelRange range = VoxelRange::segment,
                             double independence = 1.0);

/// One-dimensional corridors, two- and three-dimensional grids; none has over 12 voxels, so that three levels can be
/// enumerated too, but those of `large`, for two levels.
std::vector<Shape> small();
std::vector<Shape> large();

}  // namespace nextview::random_problems
