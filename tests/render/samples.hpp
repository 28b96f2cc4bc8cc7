#pragma once
#include <cstdint>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "ui/layers/rays_layer.hpp"

/// Things to draw. Made here, so that a picture changes only if the drawing does.
namespace nextview::samples {

/// Where the camera stands in most pictures: it sees the torus obliquely, a little from above.
inline const Vector3 usual_viewer(0.5, -0.8, 0.4);

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

/// One value per voxel: |probability - truth|, none at the torus' foot.
std::vector<float> errors(const Map& map);
/// One value per voxel: what a map that knows how rays end would add to the probability, none far from the torus.
std::vector<float> differences(const Map& map);

/// The clouds of several viewers, with their views and distances to the torus; a few points have none.
struct ScannedCloud {
  PointCloud points;
  std::vector<std::uint16_t> views;
  std::vector<float> distances;  ///< [m]
};
ScannedCloud scanned_cloud(const std::vector<Vector3>& viewers);

/// For each vertex of the torus: 0 seen from one of the viewers, 1 missed, 2 to be seen from nowhere (its foot).
std::vector<std::uint8_t> seen_classes(const TriangleMesh& torus, const std::vector<Vector3>& viewers);

std::vector<Pose> candidates();
/// A smooth score over the candidates, largest at the side opposite of `viewer`.
std::vector<double> scores(const std::vector<Pose>& candidates, const Vector3& viewer);

/// Rays of a camera at `pose` through a coarse grid of pixels, in short pieces.
std::vector<RaySegment> rays(const Pose& pose);

}  // namespace nextview::samples
