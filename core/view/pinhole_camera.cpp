#include "core/view/pinhole_camera.hpp"

#include <cmath>

namespace nextview {

PinholeCamera PinholeCamera::from_field_of_view(int width, int height, double horizontal_field_of_view) {
  const double focal_length = 0.5 * width / std::tan(0.5 * horizontal_field_of_view);
  return {width, height, focal_length, focal_length, 0.5 * (width - 1), 0.5 * (height - 1)};
}

}  // namespace nextview
