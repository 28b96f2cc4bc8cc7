#pragma once
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "ui/layers/rays_layer.hpp"

/// Things to draw. Made here, so that a picture changes only if the drawing does.
namespace nextview::samples {

/// A torus that stands on its edge, 0.5 m wide.
TriangleMesh torus();

/// Points on the part of the torus that faces `viewer`, with a little noise.
PointCloud cloud(const Vector3& viewer);

/// A map of the torus as a camera at `viewer` would leave it: its near side occupied, a shell of unknown around, the
/// way there free.
struct Map {
  VoxelGrid grid;
  std::vector<Voxel> voxels;
};
Map map(const Vector3& viewer);

std::vector<Pose> candidates();
/// A smooth score over the candidates, largest at the side opposite of `viewer`.
std::vector<double> scores(const std::vector<Pose>& candidates, const Vector3& viewer);

/// Rays of a camera at `pose` through a coarse grid of pixels, in short pieces.
std::vector<RaySegment> rays(const Pose& pose);

}  // namespace nextview::samples
