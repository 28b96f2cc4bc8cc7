#pragma once
#include <random>

#include "core/cloud/point_cloud.hpp"

namespace nextview::random_scans {

inline Vector3 point_in_box(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> d(-reach, reach);
  return {d(random), d(random), d(random)};
}

inline Vector3 direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

/// Returns of a noisy sphere seen from `origin`, and wild ones from 1 mm to 4 m away in all directions; some of them
/// exactly along an axis, and some with coordinates on voxel faces.
inline Scan scan(std::mt19937& random, const Vector3& origin, double resolution, int count, double max_range = 1.5) {
  Scan result{origin, {}, {}, max_range};
  std::normal_distribution<double> noise(0.0, 0.004);
  std::uniform_real_distribution<double> range(0.001, 4.0);
  for (int n = 0; n < count; ++n) {
    Vector3 point;
    switch (n % 8) {
      case 0:
        point = origin + range(random) * direction(random);
        break;
      case 1:
        point = origin;
        point[n / 8 % 3] += (n % 16 < 8 ? 1 : -1) * range(random);
        break;
      case 2:
        point = ((origin + range(random) * direction(random)) / resolution).array().round() * resolution;
        break;
      default:
        point = (0.2 + noise(random)) * direction(random);
    }
    result.hits.push_back(point.cast<float>());
  }
  return result;
}

/// Rays that met nothing, given up at the maximum range.
inline void add_passes(Scan& scan, std::mt19937& random, int count) {
  for (int n = 0; n < count; ++n) {
    const Vector3 towards = point_in_box(random, 0.5) - scan.origin;
    scan.misses.push_back((scan.origin + scan.max_range * towards.normalized()).cast<float>());
  }
}

/// Camera centres outside and inside of a region around the origin, far enough to be out of range, and on voxel faces.
inline std::vector<Vector3> origins() {
  return {{0.9, 0.1, 0.2}, {-0.61, 0.53, -0.4}, {0.05, 0.033, 0.271},
          {0.0, 0.0, 0.3}, {-0.02, 1.1, 0.06},  {1.7, -0.9, 0.4}};
}

}  // namespace nextview::random_scans
