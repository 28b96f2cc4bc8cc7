#pragma once
#include "core/gibbs/forward_sensor_model.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {

/// What the forward sensor models say of one ray that meets one voxel.
struct SensorModelPicture {
  /// Sigma, weights and attenuations. Its kind does not matter: all kinds are drawn.
  ForwardSensorModel model;
  double resolution = 0.01;  ///< voxel edge [m]
  double surface = 0.9;      ///< where the ray enters the occupied voxel, to the next whole voxel [m]
  double max_range = 1.5;    ///< [m]
};

/// p(z | the first occupied voxel) over the range z, a panel a model, logarithmic, each as it is: not made to sum up to
/// one. Each says what its curve adds up to over all ranges, and what it gives to 'beyond range'. Drawn in the
/// target, whatever its size.
/// @throws std::invalid_argument if the model is not valid, or the surface is not within the maximum range.
Image draw_sensor_model_figure(RenderTarget& target, const SensorModelPicture& picture);

}  // namespace nextview
