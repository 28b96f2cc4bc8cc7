#include "core/recording/cloud_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nextview {
namespace {

const double steepest = std::tan(75.0 * M_PI / 180.0);  // of x / z and y / z: 150 degrees from edge to edge
constexpr double flattest = 1e-3;                       // a single line of points has some width
constexpr int most_pixels = 640, fewest_pixels = 2;     // a side

int pixels(double focal_length, double extent) {
  return std::clamp(static_cast<int>(std::lround(focal_length * extent)) + 1, fewest_pixels, most_pixels);
}

/// Points per area, where there are any: the parts of their box that hold none do not count. 0 if it has no area.
double density(const std::vector<Eigen::Array2d>& points) {
  constexpr double points_a_part = 4.0;
  if (points.empty()) return 0.0;
  Eigen::Array2d low = points.front(), high = low;
  for (const Eigen::Array2d& point : points) low = low.min(point), high = high.max(point);
  const Eigen::Array2d extent = high - low;
  if (extent.minCoeff() <= flattest) return 0.0;
  const double edge = std::sqrt(extent.prod() * points_a_part / double(points.size()));
  const Eigen::Array2i parts = (extent / edge).round().cast<int>().max(1);
  std::vector<std::uint8_t> holds_any(std::size_t(parts.prod()));
  for (const Eigen::Array2d& point : points) {
    const Eigen::Array2i at = ((point - low) / extent * parts.cast<double>()).cast<int>().min(parts - 1);
    holds_any[std::size_t(at.y()) * std::size_t(parts.x()) + std::size_t(at.x())] = 1;
  }
  const auto held = double(std::ranges::count(holds_any, 1));
  return double(points.size()) / (extent.prod() * held / double(holds_any.size()));
}

}  // namespace

void CloudCamera::see(const Vector3& point) {
  ++points_;
  const Eigen::Array2d slope = point.head<2>().array() / point.z();
  const bool held = point.z() > 0.0 && slope.abs().maxCoeff() <= steepest;
  outside_ += !held;
  if (!held) return;
  low_ = low_.min(slope);
  high_ = high_.max(slope);
  frame_.push_back(slope);
}

void CloudCamera::end_of_frame() {
  if (const double of_frame = density(frame_); of_frame > 0.0) densities_.push_back(of_frame);
  frame_.clear();
}

PinholeCamera CloudCamera::camera() const {
  Eigen::Array2d low = low_, high = high_;
  if (outside_ == points_) {  // all behind it
    low.fill(-steepest);
    high.fill(steepest);
  }
  const Eigen::Array2d wider = (flattest - (high - low)).max(0.0) / 2.0;
  low -= wider;
  high += wider;
  const Eigen::Array2d extent = high - low;
  std::vector<double> densities = densities_;
  const auto median = densities.begin() + std::ptrdiff_t(densities.size() / 2);
  std::nth_element(densities.begin(), median, densities.end());
  const double dense = std::max(densities.empty() ? 0.0 : *median, 4.0 / extent.prod());
  const double focal_length = std::min(std::sqrt(dense), (most_pixels - 1) / extent.maxCoeff());
  // The outermost rays go through the centres of the outermost pixels.
  PinholeCamera camera{pixels(focal_length, extent.x()), pixels(focal_length, extent.y())};
  camera.fx = (camera.width - 1) / extent.x();
  camera.fy = (camera.height - 1) / extent.y();
  camera.cx = -low.x() * camera.fx;
  camera.cy = -low.y() * camera.fy;
  return camera;
}

std::string CloudCamera::outside() const {
  if (outside_ == 0) return "";
  return fmt::format("{:.1f} % of the rays lie outside the camera of 150 degrees that stands for the sensor",
                     100.0 * static_cast<double>(outside_) / static_cast<double>(points_));
}

}  // namespace nextview
