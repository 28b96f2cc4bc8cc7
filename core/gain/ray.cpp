#include "core/gain/ray.hpp"

#include <cmath>

namespace nextview {
namespace {

/// Of as much of the image around a ray [px]: what is as large, but farther off the optical axis, looks smaller.
double solid_angle(const PinholeCamera& camera, const Vector3& direction, double width, double height) {
  return width / camera.fx * height / camera.fy * direction.z() * direction.z() * direction.z();
}

}  // namespace

RayBundle RayBundle::regular(const PinholeCamera& camera, int columns, int rows, double window) {
  RayBundle bundle;
  const double width = window * camera.width / columns, height = window * camera.height / rows;
  const double left = 0.5 * (1.0 - window) * camera.width, top = 0.5 * (1.0 - window) * camera.height;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      bundle.directions.push_back(
          camera.direction(left + (column + 0.5) * width - 0.5, top + (row + 0.5) * height - 0.5));
      bundle.solid_angles.push_back(solid_angle(camera, bundle.directions.back(), width, height));
    }
  return bundle;
}

RayBundle RayBundle::reference(const PinholeCamera& camera, Eigen::Vector2d lowest, Eigen::Vector2d highest,
                               Eigen::Vector2d spacing) {
  RayBundle bundle;
  const double slack = 1e-9;  // the last column and row are part of the bundle, whatever the sums round to
  for (double x = lowest.x() * camera.width; x <= highest.x() * camera.width + slack; x += spacing.x())
    for (double y = lowest.y() * camera.height; y <= highest.y() * camera.height + slack; y += spacing.y()) {
      bundle.directions.push_back(camera.direction(std::floor(x), std::floor(y)));
      bundle.solid_angles.push_back(solid_angle(camera, bundle.directions.back(), spacing.x(), spacing.y()));
    }
  return bundle;
}

}  // namespace nextview
