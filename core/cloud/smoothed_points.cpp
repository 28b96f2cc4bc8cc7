#include "core/cloud/smoothed_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nextview {
namespace {

constexpr float widest = 6.0f;           // at depth 1 in the image, 80 degrees off its axis; points beyond stay
constexpr float cells_across = 2048.0f;  // the image, at most
constexpr float same_surface = 4.0f;     // [standard deviations]
constexpr double wanted_deviations = 6.0;
constexpr double most_across = 24.0;  // points of a window; with more it takes longer than the map does

/// A point in the image: where, and how far from the camera.
struct ImagePoint {
  float u, v, range;
  std::uint32_t number;  ///< of the hit
};

/// The points of an image in cells as large as half a window, row by row, so that the window around a point lies in its
/// cell and the eight around it.
class ImageCells {
 public:
  ImageCells(const Scan& scan, const Pose& T_world_camera, double half_window) {
    const Pose T_camera_world = T_world_camera.inverse();
    std::vector<ImagePoint> unsorted;
    Eigen::AlignedBox2f box;
    for (std::uint32_t i = 0; i < scan.hits.size(); ++i) {
      const Vector3 at = T_camera_world * scan.hits[i].cast<double>();
      const ImagePoint point{float(at.x() / at.z()), float(at.y() / at.z()), float(at.norm()), i};
      if (!(at.z() > 0.0 && std::abs(point.u) < widest && std::abs(point.v) < widest)) continue;
      unsorted.push_back(point);
      box.extend(Eigen::Vector2f(point.u, point.v));
    }
    if (unsorted.empty()) return;
    lower_ = box.min();
    edge_ = std::max(float(half_window), box.sizes().maxCoeff() / cells_across);
    columns_ = std::size_t(box.sizes().x() / edge_) + 3;
    const std::size_t rows = std::size_t(box.sizes().y() / edge_) + 3;
    begins_.resize(columns_ * rows + 1);
    for (const ImagePoint& point : unsorted) ++begins_[cell(point) + 1];
    std::inclusive_scan(begins_.begin(), begins_.end(), begins_.begin());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    points_.resize(unsorted.size());
    for (const ImagePoint& point : unsorted) points_[next[cell(point)]++] = point;
  }

  const std::vector<ImagePoint>& points() const { return points_; }

  /// Calls `each` with the points of the cells in which the window around a point lies.
  template <class Each>
  void around(const ImagePoint& point, const Each& each) const {
    const std::size_t middle = cell(point);
    for (const std::size_t row : {middle - columns_, middle, middle + columns_})
      for (std::uint32_t i = begins_[row - 1]; i < begins_[row + 2]; ++i) each(points_[i]);
  }

 private:
  std::size_t cell(const ImagePoint& point) const {
    const auto along = [&](float way) { return std::size_t(way / edge_) + 1; };
    return along(point.v - lower_.y()) * columns_ + along(point.u - lower_.x());
  }

  Eigen::Vector2f lower_ = Eigen::Vector2f::Zero();
  float edge_ = 1.0f;
  std::size_t columns_ = 0;  ///< as the rows, one more on either side than there are points in
  std::vector<std::uint32_t> begins_;
  std::vector<ImagePoint> points_;
};

/// How far behind the point the plane of those around it lies [m].
double way_to_plane(const ImageCells& cells, const ImagePoint& point, const Smoothing& smoothing) {
  const auto half_window = float(smoothing.half_window), farthest = same_surface * float(smoothing.noise);
  double count = 0.0, way = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(), slope = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  cells.around(point, [&](const ImagePoint& other) {
    const float u = other.u - point.u, v = other.v - point.v, behind = other.range - point.range;
    if (std::abs(u) > half_window || std::abs(v) > half_window || std::abs(behind) > farthest) return;
    const Eigen::Vector2d at(u, v);
    count += 1.0, way += behind, middle += at, slope += behind * at, spread += at * at.transpose();
  });
  way /= count, middle /= count;
  slope -= count * way * middle;
  spread -= count * middle * middle.transpose();
  // Points in a row, or so few of them, say nothing of a plane.
  if (!(spread.determinant() > 0.01 * spread.trace() * spread.trace())) return way;
  return way - middle.dot(spread.inverse() * slope);
}

}  // namespace

Smoothing Smoothing::down_to(double wanted, double noise, double solid_angle) {
  const double across = std::min(most_across, wanted_deviations * noise / wanted);
  return {noise, 0.5 * across * std::sqrt(solid_angle)};
}

double Smoothing::least(double noise) { return wanted_deviations * noise / most_across; }

PointCloud smoothed_points(const Scan& scan, const Pose& T_world_camera, const Smoothing& smoothing) {
  PointCloud smoothed = scan.hits;
  if (!(smoothing.half_window > 0.0)) return smoothed;
  const ImageCells cells(scan, T_world_camera, smoothing.half_window);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.points().size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const ImagePoint& point = cells.points()[i];
      const double way = way_to_plane(cells, point, smoothing);
      Eigen::Vector3f& hit = smoothed[point.number];
      const Vector3 ray = hit.cast<double>() - scan.origin;
      hit = (scan.origin + (1.0 + way / ray.norm()) * ray).cast<float>();
    }
  });
  return smoothed;
}

}  // namespace nextview
