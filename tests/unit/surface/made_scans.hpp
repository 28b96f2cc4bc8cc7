#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/view/pose.hpp"

/// Scans of known surfaces, made from formulas, for the tests of surfaces of clouds.
namespace nextview::made_scans {

/// The range at which a ray from `origin` along the unit `direction` meets something [m].
using Cast = std::function<std::optional<double>(const Vector3& origin, const Vector3& direction)>;

struct Camera {
  double pitch = 0.0025;  ///< of the pixels, on what it looks at [m]
  int half_width = 48;    ///< 2 n + 1 pixels across
  double noise = 0.0;     ///< standard deviation along the ray [m]
};

/// What a camera at `origin` that looks at `target` returns.
inline Scan scan(const Vector3& origin, const Vector3& target, const Camera& camera, const Cast& cast,
                 std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Pose pose = look_at(origin, target);
  const double distance = (target - origin).norm();
  Scan result;
  result.origin = origin;
  for (int v = -camera.half_width; v <= camera.half_width; ++v)
    for (int u = -camera.half_width; u <= camera.half_width; ++u) {
      const Vector3 direction = pose.linear() * Vector3(camera.pitch * u, camera.pitch * v, distance).normalized();
      if (const auto range = cast(origin, direction))
        result.hits.push_back((origin + (*range + camera.noise * normal(random)) * direction).cast<float>());
    }
  return result;
}

inline Cast sphere(const Vector3& centre, double radius) {
  return [=](const Vector3& origin, const Vector3& direction) -> std::optional<double> {
    const Vector3 to = centre - origin;
    const double along = to.dot(direction), inside = radius * radius - (to.squaredNorm() - along * along);
    // As a real camera: nothing at grazing incidence, from 80 degrees on.
    if (inside < std::pow(radius * std::cos(80.0 * std::numbers::pi / 180.0), 2)) return {};
    return along - std::sqrt(inside);
  };
}

/// A plate of 0.1 m x 0.1 m between z = 0 and z = `thickness`, its rims not seen.
inline Cast plate(double thickness) {
  return [=](const Vector3& origin, const Vector3& direction) -> std::optional<double> {
    const double z = origin.z() > 0.0 ? thickness : 0.0, range = (z - origin.z()) / direction.z();
    const Vector3 at = origin + range * direction;
    if (range <= 0.0 || at.head<2>().cwiseAbs().maxCoeff() > 0.05) return {};
    return range;
  };
}

/// Views of a sphere around the origin from the corners of a cube and from all sides, in turn; `from_below` or not.
inline std::vector<Scan> views_of_sphere(double radius, const Camera& camera, bool from_below, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Scan> scans;
  for (int k = 0; k < 27; ++k) {
    const Vector3 side(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (side.isZero() || (side.z() < 0.0 && !from_below)) continue;
    if (side.cwiseAbs().sum() == 2.0) continue;
    scans.push_back(scan(0.6 * side.normalized(), Vector3::Zero(), camera, sphere(Vector3::Zero(), radius), random));
  }
  return scans;
}

}  // namespace nextview::made_scans
