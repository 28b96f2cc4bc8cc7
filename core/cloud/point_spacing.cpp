#include "core/cloud/point_spacing.hpp"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>

namespace nextview {

double point_spacing(const PointCloud& points) {
  if (points.size() < 2) return 0.0;
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3f p = point - points.front();
    cloud->emplace_back(p.x(), p.y(), p.z());
  }
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  constexpr std::size_t most = 1000;
  std::vector<float> squared;
  std::vector<int> nearest(2);
  std::vector<float> distances(2);
  for (std::size_t i = 0; i < cloud->size(); i += (cloud->size() + most - 1) / most)
    if (tree.nearestKSearch((*cloud)[i], 2, nearest, distances) == 2) squared.push_back(distances[1]);
  if (squared.empty()) return 0.0;
  const auto middle = squared.begin() + std::ptrdiff_t(squared.size() / 2);
  std::ranges::nth_element(squared, middle);
  return std::sqrt(double(*middle));
}

}  // namespace nextview
