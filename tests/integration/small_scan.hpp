#pragma once
#include "core/config/configuration.hpp"

namespace nextview {

/// A scan that is small enough to be quick: 2 cm voxels, 12 candidates, a coarse camera.
inline Configuration small_scan() {
  Configuration c;
  c.object.file = "sphere";
  c.sensor.width = 160;
  c.sensor.height = 120;
  c.map.resolution = 0.02;
  c.views.count = 12;
  c.planner.ray_columns = 16;
  c.planner.ray_rows = 12;
  c.evaluation.surface_samples = 2000;
  c.termination.views = 5;
  c.termination.surface_left = 0.0;
  return c;
}

/// Smaller still: a step takes no time to speak of.
inline Configuration tiny_scan() {
  Configuration c;
  c.object.file = "sphere";
  c.sensor.width = 80;
  c.sensor.height = 60;
  c.map.resolution = 0.04;
  c.views.count = 8;
  c.evaluation.surface_samples = 500;
  return c;
}

}  // namespace nextview
