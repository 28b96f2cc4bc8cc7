#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace nextview {

/// A direction, evenly over the sphere for numbers that are so from 0 to 1.
inline Eigen::Vector3d on_sphere(double height, double turn) {
  const double z = 2.0 * height - 1.0, across = std::sqrt(1.0 - z * z), angle = 2.0 * std::numbers::pi * turn;
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace nextview
