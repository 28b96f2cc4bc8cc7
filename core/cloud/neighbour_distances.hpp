#pragma once
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// Mean distance of each point to its nearest neighbours [m]; missing neighbours count as 0, as in PCL. The same on any
/// number of threads. @throws Stopped
std::vector<float> neighbour_distances(const PointCloud& points, int neighbours, const std::stop_token& stop = {});

}  // namespace nextview
