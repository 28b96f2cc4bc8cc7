#pragma once
#include "core/config/configuration.hpp"

namespace nextview {

/// A scan that takes a moment only.
inline Configuration small_scan() {
  Configuration c;
  c.object.file = "sphere";
  c.sensor.width = 80;
  c.sensor.height = 60;
  c.map.resolution = 0.04;
  c.views.count = 8;
  c.planner.ray_columns = 8;
  c.planner.ray_rows = 6;
  c.evaluation.surface_samples = 500;
  c.termination.views = 4;
  c.termination.surface_left = 0.0;
  return c;
}

}  // namespace nextview
