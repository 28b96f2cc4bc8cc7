#pragma once
#include <cmath>
#include <functional>

#include "core/sensor/depth_camera.hpp"

/// What the tests of the depth camera share: a surface and the pinhole equation.
namespace nextview {

inline constexpr double degree = std::numbers::pi / 180.0;

/// A square 20 m wide through `point` across `normal`.
inline TriangleMesh plane(const Vector3& point, const Vector3& normal) {
  const Vector3 u = 10.0 * normal.unitOrthogonal(), v = normal.normalized().cross(u);
  TriangleMesh mesh;
  for (const Vector3& corner :
       {Vector3(point - u - v), Vector3(point + u - v), Vector3(point + u + v), Vector3(point - u + v)})
    mesh.vertices.push_back(corner.cast<float>());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Calls `check(pixel's index, its unit ray in the camera frame)` for all pixels, from the pinhole equation itself.
inline void for_each_pixel(const DepthCameraConfig& config,
                           const std::function<void(std::size_t, const Vector3&)>& check) {
  const double focal_length = 0.5 * config.width / std::tan(0.5 * config.field_of_view * degree);
  for (int v = 0; v < config.height; ++v)
    for (int u = 0; u < config.width; ++u) {
      const Vector3 d(u - 0.5 * (config.width - 1), v - 0.5 * (config.height - 1), focal_length);
      check(std::size_t(v) * config.width + u, d.normalized());
    }
}

}  // namespace nextview
