#include "core/evaluation/visible_samples.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/progress/stopped.hpp"

namespace nextview {

double resolved_range(const PinholeCamera& camera, double cosine, double d_reg) {
  // Half the diagonal between neighbouring pixels is d_reg there; the slant stretches one of their two distances.
  return std::min(camera.fx, camera.fy) * 2.0 * d_reg / std::sqrt(1.0 + 1.0 / (cosine * cosine));
}

namespace {

/// Those of some samples.
std::vector<std::uint32_t> visible_of(const SampledSurface& surface, const MeshRayCaster& scene,
                                      const DepthCamera& camera, const Pose& T_world_camera,
                                      std::span<const std::uint32_t> asked, double d_reg) {
  const DepthCameraConfig& config = camera.config();
  const Eigen::Vector3f origin = T_world_camera.translation().cast<float>();
  const Pose T_camera_world = T_world_camera.inverse();
  const float min_cosine = static_cast<float>(std::cos(config.grazing_limit * std::numbers::pi / 180.0));

  std::vector<std::uint32_t> in_image;
  std::vector<Eigen::Vector3f> directions;
  std::vector<float> ranges;
  for (const std::uint32_t s : asked) {
    const Eigen::Vector3f to_sample = surface.points[s] - origin;
    const float range = to_sample.norm();
    const Vector3 in_camera = T_camera_world * surface.points[s].cast<double>();
    if (range < config.min_range || range > config.max_range || in_camera.z() <= 0.0) continue;
    const Eigen::Vector2d pixel = camera.camera().project(in_camera);
    if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > config.width - 0.5 || pixel.y() > config.height - 0.5)
      continue;
    const Eigen::Vector3f direction = to_sample / range;
    const float cosine = std::abs(direction.dot(surface.normals[s]));
    if (cosine < min_cosine || range > resolved_range(camera.camera(), cosine, d_reg)) continue;
    in_image.push_back(s);
    directions.push_back(direction);
    ranges.push_back(range);
  }
  std::vector<MeshRayCaster::Hit> hits(directions.size());
  scene.cast(T_world_camera.translation(), directions, 1.01f * static_cast<float>(config.max_range), hits);
  // The sample lies on the surface: the ray meets it, give or take rounding [m].
  const auto tolerance = static_cast<float>(std::min(5e-4, config.max_range / 3000.0));
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < in_image.size(); ++i)
    if (hits[i].range > ranges[i] - tolerance) seen.push_back(in_image[i]);
  return seen;
}

}  // namespace

std::vector<std::uint32_t> visible_samples(const SampledSurface& surface, const MeshRayCaster& scene,
                                           const DepthCamera& camera, const Pose& T_world_camera,
                                           std::span<const std::uint32_t> asked, double d_reg,
                                           const std::stop_token& stop) {
  constexpr std::size_t at_once = 4096;
  std::vector<std::vector<std::uint32_t>> parts((asked.size() + at_once - 1) / at_once);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    if (stop.stop_requested()) return;
    const auto some = asked.subspan(part * at_once, std::min(at_once, asked.size() - part * at_once));
    parts[part] = visible_of(surface, scene, camera, T_world_camera, some, d_reg);
  });
  throw_if_stopped(stop);
  std::vector<std::uint32_t> seen;
  for (const auto& part : parts) seen.insert(seen.end(), part.begin(), part.end());
  return seen;
}

}  // namespace nextview
