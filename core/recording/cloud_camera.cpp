#include "core/recording/cloud_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

const double steepest = std::tan(75.0 * M_PI / 180.0);  // of x / z and y / z: 150 degrees from edge to edge
constexpr double flattest = 1e-3;                       // a single line of points has some width
constexpr int most_pixels = 640, fewest_pixels = 2;     // a side

int pixels(double focal_length, double extent) {
  return std::clamp(static_cast<int>(std::lround(focal_length * extent)) + 1, fewest_pixels, most_pixels);
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
  const double a_frame = static_cast<double>(points_) / static_cast<double>(std::max<std::size_t>(frames_, 1));
  const double focal_length =
      std::min(std::sqrt(std::max(a_frame, 4.0) / extent.prod()), (most_pixels - 1) / extent.maxCoeff());
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
