#include "ui/workbench/viewed_normals.hpp"

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

constexpr double hits_per_cell = 6.0;  // averages noise, and keeps edges
constexpr int most_cells = 400;        // along a side of the picture
constexpr double steepest = 3.0;       // a neighbour farther behind than so many cells is another surface's

/// The least rotation that takes this direction to z. Eigen's FromTwoVectors gives the same, by a singular value
/// decomposition, which the compiler takes seconds for.
Eigen::Matrix3d turn_to_z(const Vector3& direction) {
  const double w = std::sqrt(std::max(0.0, (1.0 + direction.z()) / 2));
  if (w < 1e-6) return Vector3(1, -1, -1).asDiagonal();
  return Eigen::Quaterniond(w, direction.y() / (2 * w), -direction.x() / (2 * w), 0.0).toRotationMatrix();
}

/// The scan as a coarse picture: of each cell the mean of its hits.
class CellPicture {
 public:
  explicit CellPicture(const Scan& scan) : origin_(scan.origin) {
    Vector3 forward = Vector3::Zero();
    for (const Eigen::Vector3f& hit : scan.hits) forward += (hit.cast<double>() - origin_).normalized();
    R_ = turn_to_z(forward.normalized());
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3f& hit : scan.hits) box.extend(place(hit));
    low_ = box.min();
    const Eigen::Vector2d size = box.sizes().cwiseMax(1e-6);
    const double cells = std::max(double(scan.hits.size()) / hits_per_cell, 1.0);
    edge_ = std::max(std::sqrt(size.prod() / cells), size.maxCoeff() / most_cells);
    columns_ = int(size.x() / edge_) + 1;
    rows_ = int(size.y() / edge_) + 1;
    sums_.resize(std::size_t(columns_) * std::size_t(rows_), Eigen::Vector4d::Zero());
    for (const Eigen::Vector3f& hit : scan.hits)
      if (Eigen::Vector4d* const sum = at(cell(hit))) *sum += Eigen::Vector4d(hit.x(), hit.y(), hit.z(), 1.0);
  }

  Eigen::Vector3f normal(const Eigen::Vector3f& hit) {
    const Vector3 to_camera = (origin_ - hit.cast<double>()).normalized();
    const Eigen::Vector2i here = cell(hit);
    Vector3 normal = along(here, {1, 0}, hit).cross(along(here, {0, 1}, hit));
    if (!(normal.norm() > 0.0)) return to_camera.cast<float>();
    normal.normalize();
    return (normal.dot(to_camera) < 0.0 ? Vector3(-normal) : normal).cast<float>();
  }

 private:
  /// Where a hit is in the picture, as a tangent.
  Eigen::Vector2d place(const Eigen::Vector3f& hit) const {
    const Vector3 seen = R_ * (hit.cast<double>() - origin_);
    return seen.head<2>() / std::max(seen.z(), 1e-3 * seen.norm() + 1e-12);
  }
  Eigen::Vector2i cell(const Eigen::Vector3f& hit) const { return ((place(hit) - low_) / edge_).cast<int>(); }
  Eigen::Vector4d* at(const Eigen::Vector2i& cell) {
    const bool inside = cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns_ && cell.y() < rows_;
    return inside ? &sums_[std::size_t(cell.y()) * std::size_t(columns_) + std::size_t(cell.x())] : nullptr;
  }
  /// The way from one neighbour of a cell to the opposite one, or from the cell where there is one alone.
  Vector3 along(const Eigen::Vector2i& here, const Eigen::Vector2i& step, const Eigen::Vector3f& hit) {
    const double depth = (hit.cast<double>() - origin_).norm(), farthest = steepest * edge_ * depth;
    const Vector3 middle = mean(here, hit.cast<double>());
    Vector3 ends[2] = {middle, middle};
    for (int side = 0; side < 2; ++side) {
      const Vector3 end = mean(here + (side == 0 ? -1 : 1) * step, middle);
      if ((end - middle).norm() < farthest) ends[side] = end;
    }
    return ends[1] - ends[0];
  }
  Vector3 mean(const Eigen::Vector2i& cell, const Vector3& otherwise) {
    const Eigen::Vector4d* const sum = at(cell);
    return sum && sum->w() > 0.0 ? Vector3(sum->head<3>() / sum->w()) : otherwise;
  }

  Vector3 origin_;
  Eigen::Matrix3d R_ = Eigen::Matrix3d::Identity();
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double edge_ = 1.0;
  int columns_ = 1, rows_ = 1;
  std::vector<Eigen::Vector4d> sums_;  ///< of positions, and how many
};

}  // namespace

std::vector<Eigen::Vector3f> viewed_normals(const Scan& scan, std::size_t stride) {
  std::vector<Eigen::Vector3f> normals;
  if (scan.hits.empty()) return normals;
  CellPicture picture(scan);
  for (std::size_t i = 0; i < scan.hits.size(); i += stride) normals.push_back(picture.normal(scan.hits[i]));
  return normals;
}

}  // namespace nextview
