#pragma once
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// Views of a mesh from a Fibonacci sphere of 0.9 m; without noise what is seen is the same.
struct SimulatedViews {
  std::vector<Scan> scans, ideal;
};
SimulatedViews simulate_views(const TriangleMesh& mesh, const DepthCameraConfig& camera, int count);

}  // namespace nextview
