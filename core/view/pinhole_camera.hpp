#pragma once
#include "core/view/pose.hpp"

namespace nextview {

/// A pinhole camera without distortion. Pixel (u, v) has its centre at (u, v): u right in [0, width), v down.
struct PinholeCamera {
  int width = 640;                                ///< [px]
  int height = 480;                               ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]

  /// Square pixels, principal point in the image centre, `horizontal_field_of_view` [rad].
  static PinholeCamera from_field_of_view(int width, int height, double horizontal_field_of_view);

  /// Unit direction through (u, v) in the camera frame.
  Vector3 direction(double u, double v) const { return Vector3((u - cx) / fx, (v - cy) / fy, 1.0).normalized(); }

  /// The image point of a point in front of the camera (camera frame, z > 0) [px].
  Eigen::Vector2d project(const Vector3& p) const { return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy}; }
};

}  // namespace nextview
