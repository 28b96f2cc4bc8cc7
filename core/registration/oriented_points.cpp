#include "core/registration/oriented_points.hpp"

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/cloud/thinned_points.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr double normal_radius = 3.0;        // of the neighbours that a plane is laid through [spacings]
constexpr std::size_t least_neighbours = 6;  // fewer say nothing of a plane
constexpr double same_side = 0.5;            // cosine between the normals of points that are merged

using Cell = std::array<int, 3>;

Cell cell_of(const Vector3& point, double spacing) {
  return {int(std::floor(point.x() / spacing)), int(std::floor(point.y() / spacing)),
          int(std::floor(point.z() / spacing))};
}

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
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  std::vector<OrientedPoint> oriented;
  std::vector<int> neighbours;
  std::vector<float> squared;
  for (std::size_t i = 0; i < means.positions.size(); ++i) {
    if (i % 1024 == 0) throw_if_stopped(stop);
    tree->radiusSearch(int(i), normal_radius * spacing, neighbours, squared);
    float x, y, z, curvature;
    if (neighbours.size() < least_neighbours || !estimation.computePointNormal(*cloud, neighbours, x, y, z, curvature))
      continue;
    Vector3 normal = Eigen::Vector3f(x, y, z).cast<double>().normalized();
    if (!normal.allFinite()) continue;
    if (normal.dot(scan.origin - means.positions[i]) < 0.0) normal = -normal;
    oriented.push_back({means.positions[i], normal, double(means.counts[i])});
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
