#include <fmt/format.h>
#include <pcl/common/common.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "core/cloud/neighbour_distances.hpp"
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

/// Keeps what pcl::StatisticalOutlierRemoval keeps, with its rounding. PCL's filter searches on one thread, and neither
/// it nor PCL's own tree can be stopped.
PointCloud remove_outliers(const PointCloud& points, int neighbours, double deviations, const std::stop_token& stop) {
  if (points.empty()) return {};
  const std::vector<float> distances = neighbour_distances(points, neighbours, stop);
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

std::vector<Setting> settings(CloudConfig& c) {
  return {
      {"cloud.outlier_removal", "", "statistical outlier removal", &c.outlier_removal},
      {"cloud.outlier_neighbours", "", "neighbours whose mean distance is looked at", &c.outlier_neighbours,
       from_to(1, 1000)},
      {"cloud.outlier_deviations", "", "standard deviations beyond which a point goes", &c.outlier_deviations,
       over_to(0, 100)},
      {"cloud.down_sampling", "", "voxel-grid down-sampling", &c.down_sampling},
      {"cloud.down_sampling_leaf", "m", "edge of its voxels", &c.down_sampling_leaf, from_to(1e-6, 1)},
  };
}

void CloudConfig::validate() const { require_in_bounds(*this); }

PointCloud clean(const PointCloud& hits, const CloudConfig& config, const std::stop_token& stop) {
  config.validate();
  PointCloud cloud =
      config.outlier_removal ? remove_outliers(hits, config.outlier_neighbours, config.outlier_deviations, stop) : hits;
  return config.down_sampling ? down_sample(cloud, config.down_sampling_leaf) : cloud;
}

}  // namespace nextview
