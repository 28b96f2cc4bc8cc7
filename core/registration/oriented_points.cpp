#include "core/registration/oriented_points.hpp"

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/cloud/thinned_points.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr double normal_radius = 3.0;        // of the neighbours that a plane is laid through [spacings]
constexpr std::size_t least_neighbours = 6;  // fewer say nothing of a plane
constexpr double same_side = 0.5;            // cosine between the normals of points that are merged

MergedPoints::Cell cell_of(const Vector3& point, double spacing) {
  const auto along = [&](int axis) { return std::int64_t(std::floor(point[axis] / spacing)); };
  return {along(0), along(1), along(2)};
}

/// Lays planes through points of a cloud and their neighbours. One of a thread's own: the estimation keeps what it
/// works with.
class Planes {
 public:
  Planes(const pcl::PointCloud<pcl::PointXYZ>& cloud, const pcl::search::KdTree<pcl::PointXYZ>& tree, double radius)
      : cloud_(cloud), tree_(tree), radius_(radius) {}

  /// None of a point that has too few neighbours.
  std::optional<Vector3> normal_at(std::size_t point) {
    tree_.radiusSearch(int(point), radius_, neighbours_, squared_);
    float x, y, z, curvature;
    if (neighbours_.size() < least_neighbours ||
        !estimation_.computePointNormal(cloud_, neighbours_, x, y, z, curvature))
      return std::nullopt;
    const Vector3 normal = Eigen::Vector3f(x, y, z).cast<double>().normalized();
    return normal.allFinite() ? std::optional(normal) : std::nullopt;
  }

 private:
  const pcl::PointCloud<pcl::PointXYZ>& cloud_;
  const pcl::search::KdTree<pcl::PointXYZ>& tree_;
  double radius_;
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation_;
  std::vector<int> neighbours_;
  std::vector<float> squared_;
};

}  // namespace

std::vector<OrientedPoint> oriented_points(const Scan& scan, double spacing, const std::stop_token& stop) {
  const ThinnedPoints means = thinned(scan.hits, spacing);
  throw_if_stopped(stop);
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  // Around the scan's origin: single precision is finest there, wherever the world's origin is.
  for (const Vector3& p : means.positions) {
    const Eigen::Vector3f from = (p - scan.origin).cast<float>();
    cloud->emplace_back(from.x(), from.y(), from.z());
  }
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  if (!cloud->empty()) tree->setInputCloud(cloud);
  std::vector<std::optional<Vector3>> normals(means.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), 256), [&](const auto& range) {
    if (stop.stop_requested()) return;
    Planes planes(*cloud, *tree, normal_radius * spacing);
    for (std::size_t i = range.begin(); i != range.end(); ++i) normals[i] = planes.normal_at(i);
  });
  throw_if_stopped(stop);
  std::vector<OrientedPoint> oriented;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!normals[i]) continue;
    const bool turned = normals[i]->dot(scan.origin - means.positions[i]) < 0.0;
    oriented.push_back({means.positions[i], turned ? Vector3(-*normals[i]) : *normals[i], double(means.counts[i])});
  }
  return oriented;
}

void MergedPoints::add(const std::vector<OrientedPoint>& scan) {
  for (const OrientedPoint& p : scan) {
    std::vector<std::size_t>& here = at_[cell_of(p.position, spacing_)];
    const auto same = std::ranges::find_if(
        here, [&](std::size_t i) { return sums_[i].normal.normalized().dot(p.normal) > same_side; });
    if (same == here.end()) {
      here.push_back(sums_.size());
      sums_.push_back({p.weight * p.position, p.weight * p.normal, p.weight});
      continue;
    }
    sums_[*same].position += p.weight * p.position;
    sums_[*same].normal += p.weight * p.normal;
    sums_[*same].weight += p.weight;
  }
}

std::vector<OrientedPoint> MergedPoints::points() const {
  std::vector<OrientedPoint> all = sums_;
  for (OrientedPoint& p : all) {
    p.position /= p.weight;
    p.normal.normalize();
  }
  return all;
}

}  // namespace nextview
