#pragma once
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The directions out of the surface at every `stride`-th hit of a scan, of length 1 and towards the camera, to shade
/// points by: planes through the means of neighbouring cells of the camera's picture. Where those say nothing, the
/// direction to the camera. Linear in the hits.
std::vector<Eigen::Vector3f> viewed_normals(const Scan& scan, std::size_t stride);

}  // namespace nextview
