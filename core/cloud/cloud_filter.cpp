#include <fmt/format.h>
#include <pcl/common/common.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "core/cloud/point_cloud.hpp"

namespace nextview {
namespace {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

std::shared_ptr<PclCloud> to_pcl(const PointCloud& points) {
  auto cloud = std::make_shared<PclCloud>();
  cloud->reserve(points.size());
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  return cloud;
}

/// Mean distance of each point to its nearest neighbours [m]; missing neighbours count as 0, as in PCL.
std::vector<float> neighbour_distances(const PclCloud::ConstPtr& cloud, int neighbours) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(cloud);
  std::vector<float> distances(cloud->size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud->size(), 1024), [&](const auto& range) {
    pcl::Indices indices;
    std::vector<float> squared;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      tree.nearestKSearch((*cloud)[i], neighbours + 1, indices, squared);  // one more: the point finds itself first
      double sum = 0.0;
      for (std::size_t k = 1; k < squared.size(); ++k) sum += std::sqrt(static_cast<double>(squared[k]));
      distances[i] = static_cast<float>(sum / neighbours);
    }
  });
  return distances;
}

/// Keeps what pcl::StatisticalOutlierRemoval keeps, with PCL's own k-d tree and PCL's rounding; PCL's filter searches
/// on one thread, and the search is nearly all of its time.
PointCloud remove_outliers(const PointCloud& points, int neighbours, double deviations) {
  if (points.empty()) return {};
  const std::vector<float> distances = neighbour_distances(to_pcl(points), neighbours);
  double sum = 0.0, squares = 0.0;
  for (const float d : distances) {
    sum += d;
    squares += d * d;
  }
  const double n = static_cast<double>(points.size());
  const double threshold = sum / n + deviations * std::sqrt((squares - sum * sum / n) / (n - 1.0));
  PointCloud kept;
  kept.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(distances[i] > threshold)) kept.push_back(points[i]);  // a single point has no threshold (NaN) and stays
  return kept;
}

/// An upper bound of the number of leaves in a cloud's bounding box.
double leaf_count(const Eigen::Vector4f& lower, const Eigen::Vector4f& upper, double leaf) {
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis) count *= std::floor(upper[axis] / leaf) - std::floor(lower[axis] / leaf) + 2.0;
  return count;
}

void check_leaf(const PclCloud& cloud, double leaf) {
  constexpr double limit = std::numeric_limits<std::int32_t>::max();
  Eigen::Vector4f lower, upper;
  pcl::getMinMax3D(cloud, lower, upper);
  const double farthest = std::max(upper.head<3>().cwiseAbs().maxCoeff(), lower.head<3>().cwiseAbs().maxCoeff());
  const auto fits = [&](double edge) { return leaf_count(lower, upper, edge) <= limit && farthest / edge < limit; };
  if (fits(leaf)) return;
  double smallest = leaf;
  while (!fits(smallest)) smallest *= 1.1;
  const Eigen::Vector4f extent = upper - lower;
  throw std::invalid_argument(
      fmt::format("cloud: down_sampling_leaf {} m is too small for a cloud of {:.3g} x {:.3g} x {:.3g} m; it must be "
                  "at least {:.3g} m",
                  leaf, extent.x(), extent.y(), extent.z(), 1.01 * smallest));
}

PointCloud down_sample(const PointCloud& points, double leaf) {
  if (points.empty()) return {};
  const auto cloud = to_pcl(points);
  check_leaf(*cloud, leaf);
  pcl::VoxelGrid<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setLeafSize(float(leaf), float(leaf), float(leaf));
  PclCloud sampled;
  filter.filter(sampled);
  PointCloud result;
  result.reserve(sampled.size());
  for (const auto& p : sampled) result.emplace_back(p.x, p.y, p.z);
  return result;
}

}  // namespace

void CloudConfig::validate() const {
  if (outlier_neighbours < 1 || outlier_neighbours > 1000)
    throw std::invalid_argument(
        fmt::format("cloud: outlier_neighbours must be from 1 to 1000, not {}", outlier_neighbours));
  if (!(outlier_deviations > 0.0 && outlier_deviations <= 100.0))
    throw std::invalid_argument(
        fmt::format("cloud: outlier_deviations must be over 0 and at most 100, not {}", outlier_deviations));
  if (!(down_sampling_leaf >= 1e-6 && down_sampling_leaf <= 1.0))
    throw std::invalid_argument(
        fmt::format("cloud: down_sampling_leaf must be from 0.000001 to 1 m, not {}", down_sampling_leaf));
}

PointCloud clean(const PointCloud& returns, const CloudConfig& config) {
  config.validate();
  PointCloud cloud =
      config.outlier_removal ? remove_outliers(returns, config.outlier_neighbours, config.outlier_deviations) : returns;
  return config.down_sampling ? down_sample(cloud, config.down_sampling_leaf) : cloud;
}

}  // namespace nextview
