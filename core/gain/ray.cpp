#include "core/gain/ray.hpp"

#include <cmath>

namespace nextview {

RayBundle RayBundle::regular(const PinholeCamera& camera, int columns, int rows) {
  RayBundle bundle;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      bundle.directions.push_back(
          camera.direction((column + 0.5) * camera.width / columns - 0.5, (row + 0.5) * camera.height / rows - 0.5));
  return bundle;
}

RayBundle RayBundle::reference(const PinholeCamera& camera, Eigen::Vector2d lowest, Eigen::Vector2d highest,
                               Eigen::Vector2d spacing) {
  RayBundle bundle;
  const double slack = 1e-9;  // the last column and row are part of the bundle, whatever the sums round to
  for (double x = lowest.x() * camera.width; x <= highest.x() * camera.width + slack; x += spacing.x())
    for (double y = lowest.y() * camera.height; y <= highest.y() * camera.height + slack; y += spacing.y())
      bundle.directions.push_back(camera.direction(std::floor(x), std::floor(y)));
  return bundle;
}

}  // namespace nextview
