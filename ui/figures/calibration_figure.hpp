#pragma once
#include "core/offline/map_calibration.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

/// What calibrating the conventional map did: the descent of BFGS, the updates before and after, how well the map
/// agrees with the Gibbs map on held-out objects, and each object's scores. Drawn headless (ensure_headless). Made for
/// 1600 x 1000 pixels.
/// @throws std::invalid_argument if there is no example.
Image draw_calibration_figure(const MapCalibration& calibration, int width = 1600, int height = 1000);

}  // namespace nextview
