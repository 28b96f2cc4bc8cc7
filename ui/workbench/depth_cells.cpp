#include "ui/workbench/depth_cells.hpp"

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

constexpr int thumbnail_columns = 64;
constexpr int max_thumbnail_rows = 64;  ///< of a camera that stands upright

}  // namespace

DepthCells measured_depth(const Scan& scan, const Pose& T_world_camera, const PinholeCamera& camera, int columns,
                          int rows) {
  DepthCells cells{columns, rows, std::vector<float>(std::size_t(columns) * std::size_t(rows), -1.0f)};
  const Pose T_camera_world = T_world_camera.inverse();
  for (const Eigen::Vector3f& point : scan.hits) {
    const Vector3 p = T_camera_world * point.cast<double>();
    if (!(p.z() > 0)) continue;
    const Eigen::Vector2d pixel = camera.project(p);
    const double column = std::floor((pixel.x() + 0.5) * columns / camera.width);
    const double row = std::floor((pixel.y() + 0.5) * rows / camera.height);
    if (!(column >= 0 && row >= 0 && column < columns && row < rows)) continue;
    float& nearest = cells.depth[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    if (nearest < 0 || p.z() < nearest) nearest = static_cast<float>(p.z());
  }
  return cells;
}

DepthCells thumbnail(const Scan& scan, const Pose& T_world_camera, const PinholeCamera& camera) {
  const double rows = double(thumbnail_columns) * camera.height / camera.width;
  return measured_depth(scan, T_world_camera, camera, thumbnail_columns,
                        std::clamp(int(std::lround(rows)), 1, max_thumbnail_rows));
}

}  // namespace nextview
