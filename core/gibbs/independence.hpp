#pragma once
#include "core/gibbs/forward_sensor_model.hpp"

namespace nextview {

/// How dense images are: of the rays that end in the grid, how many of one image see the same place, that is lie in one
/// cell of directions a voxel edge wide (at the grid's centre).
struct HitCells {
  double rays = 0.0;      ///< that end in the grid; merged ones count as many as they stand for
  std::size_t cells = 0;  ///< that have any, image by image

  /// Those of other images.
  void add(const HitCells& others) { rays += others.rays, cells += others.cells; }
  double rays_per_cell() const;  ///< at least 1
};
HitCells hit_cells(const RangeMeasurements& measurements, const VoxelGrid& grid);

/// The power of the likelihood that such density asks for, 2 / density and at most 1: what the rays of an image say of
/// a place counts as much as two independent rays would. By the log loss near the surface of made-up parts.
double independence_at(double rays_per_hit_cell);

/// The model with an independence that is not 0: attenuation has it from the rays' density, as it was fitted for that
/// model; the other models take rays for independent.
ForwardSensorModel with_independence(ForwardSensorModel model, const RangeMeasurements& measurements,
                                     const VoxelGrid& grid);
/// The same, for who has counted. @pre the hits are counted if they are asked for
ForwardSensorModel with_independence(ForwardSensorModel model, const HitCells& hits);
bool independence_follows_from_hits(const ForwardSensorModel& model);

}  // namespace nextview
