#pragma once
#include <cmath>
#include <limits>
#include <vector>

#include "core/view/pinhole_camera.hpp"

namespace nextview {

/// One range a pixel, along the pixel's ray (not along z) [m], row by row. A pixel is one of three things:
/// a range; *beyond range*, nothing was met within the maximum range (it says the way is free); or *invalid*, which
/// says nothing.
struct DepthImage {
  PinholeCamera camera;
  std::vector<float> range;  ///< width * height values

  static constexpr float beyond_range = std::numeric_limits<float>::infinity();
  static constexpr float invalid = std::numeric_limits<float>::quiet_NaN();
  static bool is_range(float r) { return std::isfinite(r); }
  static bool is_beyond_range(float r) { return std::isinf(r); }
};

}  // namespace nextview
