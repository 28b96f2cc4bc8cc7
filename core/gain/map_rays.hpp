#pragma once
#include <memory>
#include <stop_token>

#include "core/gain/gain.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// How a ray ends.
struct RayEnd {
  double range = -1.0;  ///< at which it enters the voxel that stops it [m]; negative: nothing does
  bool crosses_unmeasured = false;
};

/// Rays through a map, clipped to its region of interest (published semantics). It has its own copy of the voxels.
class MapRays : public RayCaster {
 public:
  MapRays(const VoxelGrid& grid, VoxelBricks voxels, double occupancy_threshold, double max_range);
  void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const override;
  std::optional<WorthOfMap> worth_of_map(const Gain& gain, double occlusion_reach) const override;
  /// Of the same ray, without all that gains ask of the voxels on it.
  RayEnd end(const Vector3& origin, const Vector3& direction) const;

 private:
  VoxelGrid grid_;
  VoxelBricks voxels_;
  double occupancy_threshold_;
  double max_range_;
  float surely_free_;  ///< log-odds below which no voxel of an occupancy map stops a ray
};

/// The map of the reference semantics: a real pruning octree, whose quirks are part of the numbers, with its rays.
class ReferenceMap : public RayCaster {
 public:
  struct Parameters {
    double resolution = 0.01;  ///< [m]
    InverseSensorModel model;
    double unknown_prior = 0.5;  ///< probability of what has not been measured
    bool use_bounding_box = true;
    Vector3 lower = Vector3::Zero();  ///< bounding box [m, world]; points outside are dropped
    Vector3 upper = Vector3::Zero();
    double max_sensor_range = 1.5;                           ///< [m]; negative: no limit
    double occlusion_distance = default_occlusion_distance;  ///< [m]
    double max_ray_depth = 1.5;                              ///< [m]
  };

  explicit ReferenceMap(const Parameters& parameters);
  ~ReferenceMap() override;
  /// A map of its own with the same content.
  std::unique_ptr<ReferenceMap> copy() const;

  /// @throws Stopped; then the map is half made and to be thrown away.
  void insert(const Vector3& origin, std::span<const Eigen::Vector3f> points, const std::stop_token& stop = {});
  void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const override;

 private:
  struct Tree;
  Parameters parameters_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace nextview
