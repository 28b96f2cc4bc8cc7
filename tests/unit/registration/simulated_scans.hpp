#pragma once
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <vector>

#include "core/source/inaccurate_source.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {

using Scans = std::vector<std::shared_ptr<const Scan>>;

inline std::shared_ptr<const PlacedMesh> object_named(const std::string& name) {
  return std::make_shared<PlacedMesh>(load_placed_mesh(NEXTVIEW_SOURCE_DIR "/assets/objects/" + name + ".ply"));
}

inline DepthCameraConfig noisy_camera(double range_noise) {
  DepthCameraConfig sensor;
  sensor.width = 320;
  sensor.height = 240;
  sensor.range_noise = range_noise;
  return sensor;
}

/// Views all round the object, from above [m].
inline std::vector<View> views_around(std::uint32_t count, double height = 0.4, double radius = 0.9) {
  std::vector<View> views;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    const double across = std::sqrt(radius * radius - height * height);
    views.push_back({look_at({across * std::cos(angle), across * std::sin(angle), height}, Vector3::Zero())});
  }
  return views;
}

/// Scans of an object at its size of half a metre, from a camera that errs.
inline Scans scans_of(std::shared_ptr<const PlacedMesh> object, const std::vector<View>& views, double range_noise,
                      const RobotConfig& errors = {}, std::uint64_t seed = 1) {
  const auto world = std::make_shared<const SimulatedWorld>(std::move(object), noisy_camera(range_noise));
  InaccurateSource source(std::make_unique<SimulatedSource>(world, seed), errors, seed);
  const CloudConfig cleaning;
  Scans scans;
  for (Scan& scan : take_scans(source, views, &cleaning))
    scans.push_back(std::make_shared<const Scan>(std::move(scan)));
  return scans;
}

inline PointCloud all_hits(const Scans& scans) {
  PointCloud all;
  for (const auto& scan : scans) all.insert(all.end(), scan->hits.begin(), scan->hits.end());
  return all;
}

}  // namespace nextview
