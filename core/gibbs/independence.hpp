#pragma once
#include "core/gibbs/forward_sensor_model.hpp"

namespace nextview {

/// How dense the images are: of the rays that end in the grid, how many of one image see the same place, that is lie in
/// one cell of directions a voxel edge wide (at the grid's centre). A mean over the cells that have any; at least 1.
/// Merged rays count as many as they stand for.
double rays_per_hit_cell(const RangeMeasurements& measurements, const VoxelGrid& grid);

/// The power of the likelihood that such density asks for, 2 / density and at most 1: what the rays of an image say of
/// a place counts as much as two independent rays would. By the log loss near the surface of made-up parts.
double independence_at(double rays_per_hit_cell);

/// The model with an independence that is not 0: attenuation has it from the rays' density, as it was fitted for that
/// model; the other models take rays for independent.
ForwardSensorModel with_independence(ForwardSensorModel model, const RangeMeasurements& measurements,
                                     const VoxelGrid& grid);

}  // namespace nextview
