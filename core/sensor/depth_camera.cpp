#include "core/sensor/depth_camera.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/progress/stopped.hpp"
#include "core/random/counter_random.hpp"
#include "core/setting/numbers.hpp"

namespace nextview {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// Noise may bring a surface from beyond the maximum range into it; the draws stay within this many standard
/// deviations.
constexpr double largest_noise = 7.0;

/// Four rows of an image, or what is left of it. Taken column by column, 16 pixels in a row are a block of 4 x 4: rays
/// that stay together.
struct Strip {
  static constexpr int height = 4;
  int width, first_row, rows;

  Strip(int index, const PinholeCamera& camera)
      : width(camera.width), first_row(index * height), rows(std::min(height, camera.height - first_row)) {}
  static int count(const PinholeCamera& camera) { return (camera.height + height - 1) / height; }
  int pixels() const { return rows * width; }
  std::size_t pixel(int i) const { return std::size_t(first_row + i % rows) * width + i / rows; }
};

std::vector<MeshRayCaster::Hit> cast(const MeshRayCaster& scene, const Pose& T_world_camera, const Strip& strip,
                                     const std::vector<Eigen::Vector3f>& directions, double reach) {
  const Eigen::Matrix3d R_world_camera = T_world_camera.linear();
  std::vector<Eigen::Vector3f> rays(strip.pixels());
  for (int i = 0; i < strip.pixels(); ++i)
    rays[i] = (R_world_camera * directions[strip.pixel(i)].cast<double>()).cast<float>();
  std::vector<MeshRayCaster::Hit> hits(rays.size());
  scene.cast(T_world_camera.translation(), rays, static_cast<float>(reach), hits);
  return hits;
}

/// `to_range(pixel, hit)` makes a pixel of what its ray met within `reach` [m].
template <class ToRange>
DepthImage sense_image(const MeshRayCaster& scene, const Pose& T_world_camera, const PinholeCamera& camera,
                       const std::vector<Eigen::Vector3f>& directions, double reach, const std::stop_token& stop,
                       const ToRange& to_range) {
  DepthImage image{camera, std::vector<float>(directions.size())};
  tbb::parallel_for(0, Strip::count(camera), [&](int index) {
    if (stop.stop_requested()) return;
    const Strip strip(index, camera);
    const std::vector<MeshRayCaster::Hit> hits = cast(scene, T_world_camera, strip, directions, reach);
    for (int i = 0; i < strip.pixels(); ++i) image.range[strip.pixel(i)] = to_range(strip.pixel(i), hits[i]);
  });
  throw_if_stopped(stop);
  return image;
}

}  // namespace

std::vector<Setting> settings(DepthCameraConfig& c) {
  return {
      {"sensor.width", "px", "image width", &c.width, from_to(1, 16384)},
      {"sensor.height", "px", "image height", &c.height, from_to(1, 16384)},
      {"sensor.field_of_view", "deg", "horizontal field of view", &c.field_of_view, from_to(1, 170)},
      {"sensor.intrinsics", "px", "fx fy cx cy, pixel centres at whole numbers; empty: from the field of view",
       &c.intrinsics},
      {"sensor.min_range", "m", "nearer surfaces give invalid pixels", &c.min_range, from_to(0, 1000)},
      {"sensor.max_range", "m", "farther surfaces are beyond range", &c.max_range, from_to(0.001, 1000)},
      {"sensor.range_noise", "m", "standard deviation along the ray", &c.range_noise, from_to(0, 1)},
      {"sensor.dropout", "", "share of pixels that return nothing", &c.dropout, from_to(0, 1)},
      {"sensor.outliers", "", "share of the other pixels whose range is any within the limits", &c.outliers,
       from_to(0, 1)},
      {"sensor.grazing_limit", "deg", "surfaces met at more than this from their normal give invalid pixels",
       &c.grazing_limit, from_to(0, 90)},
      {"sensor.working_distance", "m", "at which views are laid out; 0: 1.8 times the object's longest side",
       &c.working_distance, zero_or(0.001, 1000)},
      {"sensor.seconds", "s", "that a scan takes, for planner.utility gain-per-second", &c.seconds,
       from_to(0.001, 1e5)},
  };
}

void DepthCameraConfig::validate() const {
  require_in_bounds(*this);
  if (min_range > max_range)
    throw std::invalid_argument(
        fmt::format("sensor.min_range, {} m, must be at most sensor.max_range, {} m", min_range, max_range));
  camera();
}

PinholeCamera DepthCameraConfig::camera() const {
  if (!intrinsics.empty()) {
    const char* const takes = "fx fy cx cy, focal lengths from 1 to 1e6 px and a point within 1e6 px";
    const std::vector<double> v = numbers("sensor.intrinsics", intrinsics, 4, takes);
    const bool good =
        std::min(v[0], v[1]) >= 1.0 && *std::max_element(v.begin(), v.end()) <= 1e6 && std::min(v[2], v[3]) >= -1e6;
    if (!good) throw std::invalid_argument(fmt::format("sensor.intrinsics takes {}, not '{}'", takes, intrinsics));
    return {width, height, v[0], v[1], v[2], v[3]};
  }
  return PinholeCamera::from_field_of_view(width, height, field_of_view * degree);
}

DepthCamera::DepthCamera(const DepthCameraConfig& config, const std::stop_token& stop) : config_(config) {
  config.validate();
  camera_ = config.camera();
  directions_.reserve(std::size_t(camera_.width) * camera_.height);
  for (int v = 0; v < camera_.height; ++v) {
    throw_if_stopped(stop);
    for (int u = 0; u < camera_.width; ++u) directions_.push_back(camera_.direction(u, v).cast<float>());
  }
}

DepthImage DepthCamera::sense(const MeshRayCaster& scene, const Pose& T_world_camera, std::uint64_t seed,
                              std::uint32_t view_index, const std::stop_token& stop) const {
  const CounterRandom noise(seed, random_stream::range_noise, view_index);
  const CounterRandom dropout(seed, random_stream::dropout, view_index);
  const CounterRandom outliers(seed, random_stream::outliers, view_index);
  const double grazing_cosine = std::cos(config_.grazing_limit * degree);
  const auto to_range = [&](std::size_t pixel, const MeshRayCaster::Hit& hit) {
    if (config_.dropout > 0.0 && dropout.uniform(pixel)[0] < config_.dropout) return DepthImage::invalid;
    if (config_.outliers > 0.0) {
      const std::array<double, 4> draw = outliers.uniform(pixel);
      if (draw[0] < config_.outliers)
        return static_cast<float>(config_.min_range + draw[1] * (config_.max_range - config_.min_range));
    }
    if (DepthImage::is_beyond_range(hit.range)) return DepthImage::beyond_range;
    const auto range = static_cast<float>(hit.range + config_.range_noise * noise.normal(pixel)[0]);
    if (range > config_.max_range) return DepthImage::beyond_range;
    return hit.cosine < grazing_cosine || range < config_.min_range ? DepthImage::invalid : range;
  };
  const double reach = config_.max_range + largest_noise * config_.range_noise;
  return sense_image(scene, T_world_camera, camera_, directions_, reach, stop, to_range);
}

DepthImage DepthCamera::sense_ideal(const MeshRayCaster& scene, const Pose& T_world_camera,
                                    const std::stop_token& stop) const {
  const auto to_range = [&](std::size_t, const MeshRayCaster::Hit& hit) {
    return hit.range > config_.max_range   ? DepthImage::beyond_range
           : hit.range < config_.min_range ? DepthImage::invalid
                                           : hit.range;
  };
  return sense_image(scene, T_world_camera, camera_, directions_, config_.max_range, stop, to_range);
}

}  // namespace nextview
