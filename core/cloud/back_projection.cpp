#include "core/cloud/point_cloud.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {

Scan back_project(const DepthImage& image, const Pose& T_world_camera, double max_range, const std::stop_token& stop) {
  Scan scan;
  scan.origin = T_world_camera.translation();
  scan.max_range = max_range;
  const auto& camera = image.camera;
  scan.hits.reserve(image.range.size());
  for (int v = 0; v < camera.height; ++v) {
    throw_if_stopped(stop);
    for (int u = 0; u < camera.width; ++u) {
      const float range = image.range[std::size_t(v) * camera.width + u];
      const bool met_surface = DepthImage::is_range(range);
      if (!met_surface && !DepthImage::is_beyond_range(range)) continue;
      const Vector3 direction = T_world_camera.linear() * camera.direction(u, v);
      const double length = met_surface ? double(range) : max_range;
      (met_surface ? scan.hits : scan.misses).push_back((scan.origin + length * direction).cast<float>());
    }
  }
  return scan;
}

}  // namespace nextview
