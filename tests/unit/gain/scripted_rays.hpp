#pragma once
#include <cmath>
#include <random>

#include "tests/unit/gain/gain_twins.hpp"

namespace nextview {

/// A caster whose rays visit what a test wrote down, whatever the map. Direction n of bundle() meets rays[n].
struct ScriptedRays : RayCaster {
  std::vector<gain_twins::VoxelsOfRay> rays;

  void cast(const Vector3&, const Vector3& direction, std::vector<RayVoxel>& visited) const override {
    visited = rays[std::size_t(std::lround(std::atan2(direction.x(), direction.z()) / angle))];
  }
  RayBundle bundle() const {
    RayBundle bundle;
    for (std::size_t n = 0; n < rays.size(); ++n)
      bundle.directions.push_back({std::sin(double(n) * angle), 0.0, std::cos(double(n) * angle)});
    return bundle;
  }

 private:
  static constexpr double angle = 1e-3;
};

inline RayVoxel voxel(double probability, bool measured) {
  RayVoxel v;
  v.probability = float(probability);
  v.entropy = float(entropy(probability));
  v.voxel_class = InverseSensorModel().classify(probability);
  v.measured = v.has_node = measured;
  return v;
}

inline RayVoxel unmeasured(int occlusion_distance = 0) {
  RayVoxel v = voxel(0.5, false);
  v.occlusion_distance = std::uint16_t(occlusion_distance);
  v.has_node = occlusion_distance > 0;
  return v;
}

/// A voxel of any kind that a map may have; some were behind a surface before they were measured.
inline RayVoxel random_voxel(std::mt19937& random) {
  const int kind = int(random() % 6);
  if (kind == 0) return unmeasured();
  if (kind == 1) return unmeasured(1 + int(random() % 59));
  const double p = kind == 2   ? 0.85 + 0.01 * double(random() % 12)
                   : kind == 3 ? 0.21 + 0.05 * double(random() % 12)
                               : 0.12 + 0.006 * double(random() % 12);
  RayVoxel measured = voxel(p, true);
  if (random() % 4 == 0) measured.occlusion_distance = std::uint16_t(1 + random() % 59);
  return measured;
}

}  // namespace nextview
