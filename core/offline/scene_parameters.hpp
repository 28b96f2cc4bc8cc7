#pragma once
#include <functional>
#include <string>

#include "core/cloud/point_cloud.hpp"
#include "core/gain/map_rays.hpp"
#include "core/sensor/recorded_scans.hpp"

namespace nextview {

/// What a recorded scene's `param` lines say, with the reference code's defaults for what they leave out.
struct SceneParameters {
  ReferenceMap::Parameters map;
  RayBundle rays;  ///< that score a view

  /// Longest ray that counts [m].
  double max_range() const { return map.max_sensor_range < 0.0 ? 1e3 : map.max_sensor_range; }
  /// The bounding box as a dense grid. @throws std::invalid_argument if it has too many voxels
  VoxelGrid grid() const;
};

/// `warn` hears of parameters that have no meaning here.
/// @throws std::invalid_argument for a parameter that makes no sense, or a scan or view out of an octree's reach.
SceneParameters scene_parameters(const RecordedScene& scene, const std::function<void(const std::string&)>& warn = {});

/// The scans of a scene, as they are.
std::vector<Scan> scans_of(const RecordedScene& scene, const SceneParameters& parameters);

}  // namespace nextview
