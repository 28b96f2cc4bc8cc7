#pragma once
#include <cstdint>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// Points thinned to their mean in each cube of a lattice, as PCL's voxel grid does, however many cubes a cloud spans.
struct ThinnedPoints {
  std::vector<Vector3> positions;       ///< [m, world], in the order in which the cubes were met
  std::vector<std::uint32_t> counts;    ///< of the points that each stands for
  std::vector<std::uint32_t> of_point;  ///< of each point of the cloud: its place among the thinned ones
};

/// @throws std::invalid_argument if the spacing is not over 0 [m].
ThinnedPoints thinned(const PointCloud& points, double spacing);

}  // namespace nextview
