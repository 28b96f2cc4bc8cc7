#include <tbb/parallel_for.h>

#include "core/cloud/point_cloud.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// Of each row of an image: where its points begin among all of them; last, how many there are.
struct Begins {
  std::vector<std::size_t> hits, misses;
};
Begins begins_of_rows(const DepthImage& image) {
  Begins begins{{0}, {0}};
  std::size_t hits = 0, misses = 0;
  for (int v = 0; v < image.camera.height; ++v) {
    const float* const row = &image.range[std::size_t(v) * image.camera.width];
    for (int u = 0; u < image.camera.width; ++u) {
      hits += DepthImage::is_range(row[u]);
      misses += DepthImage::is_beyond_range(row[u]);
    }
    begins.hits.push_back(hits);
    begins.misses.push_back(misses);
  }
  return begins;
}

}  // namespace

Scan back_project(const DepthImage& image, const Pose& T_world_camera, double max_range, const std::stop_token& stop) {
  Scan scan;
  scan.origin = T_world_camera.translation();
  scan.max_range = max_range;
  const auto& camera = image.camera;
  const Begins begins = begins_of_rows(image);
  scan.hits.resize(begins.hits.back());
  scan.misses.resize(begins.misses.back());
  tbb::parallel_for(0, camera.height, [&](int v) {  // each row knows where its points go: the order is the image's
    if (stop.stop_requested()) return;
    auto hit = scan.hits.begin() + std::ptrdiff_t(begins.hits[v]);
    auto miss = scan.misses.begin() + std::ptrdiff_t(begins.misses[v]);
    for (int u = 0; u < camera.width; ++u) {
      const float range = image.range[std::size_t(v) * camera.width + u];
      const bool met_surface = DepthImage::is_range(range);
      if (!met_surface && !DepthImage::is_beyond_range(range)) continue;
      const Vector3 direction = T_world_camera.linear() * camera.direction(u, v);
      const double length = met_surface ? double(range) : max_range;
      *(met_surface ? hit : miss)++ = (scan.origin + length * direction).cast<float>();
    }
  });
  throw_if_stopped(stop);
  return scan;
}

}  // namespace nextview
