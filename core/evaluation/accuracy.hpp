#pragma once
#include <span>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/evaluation/mesh_distance.hpp"

namespace nextview {

/// How far points lie from the true surface [m]. Of no points all three are NaN.
struct Accuracy {
  std::size_t points = 0;
  double mean = 0.0;
  double rms = 0.0;
  double percentile_95 = 0.0;  ///< the smallest distance that at least 95 % of the points do not exceed
};

/// Distance of each point of the cloud to the surface [m], in the cloud's order.
std::vector<double> distances(const PointCloud& cloud, const MeshDistance& surface);

Accuracy summarise(std::span<const double> distances);

inline Accuracy accuracy(const PointCloud& cloud, const MeshDistance& surface) {
  return summarise(distances(cloud, surface));
}

}  // namespace nextview
