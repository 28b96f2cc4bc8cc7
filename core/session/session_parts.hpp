#pragma once
#include <functional>
#include <memory>
#include <string>

#include "core/config/configuration.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/planner/planner.hpp"
#include "core/robot/robot.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

// What a configuration says that a session is made of.

/// @throws std::invalid_argument naming the field and its bounds.
Configuration validated(Configuration configuration);

/// The same configuration. @throws OutOfMemory if the map, the camera's images or the views' clouds will not fit.
Configuration affordable(Configuration configuration);
/// One line that says what took the memory of a scan that has none left, and what to do.
std::string not_enough_memory(const Configuration& configuration);

/// What the views that the program lays out look at: the middle of the region of interest.
Vector3 view_target(const Configuration& configuration);
Pose configured_start_view(const Configuration& configuration);
/// The file of an object, and how its mesh is placed.
struct ObjectFile {
  std::filesystem::path file;
  MeshFileOptions options;

  bool operator==(const ObjectFile&) const = default;
};
/// Those of the object that a configuration names. @throws std::invalid_argument, std::runtime_error naming the file
/// or the setting
ObjectFile configured_object_file(const Configuration& configuration);
/// The object that a configuration names.
struct ConfiguredObject {
  std::filesystem::path file;
  std::shared_ptr<const PlacedMesh> placed;
};
/// How the coordinates of projection matrices (views.file) become the world's: as those of the object's file did.
/// @throws std::invalid_argument if views.unit is set and nothing says the object's
ProjectionPlacement projection_placement(const Configuration& configuration, const PlacedMesh& object);
/// Fits lengths and region to an object that was read (fit_lengths, fit_region), and puts the views of projection
/// matrices where it is.
/// @throws std::invalid_argument naming the file or the setting; OutOfMemory
void fit_to_object(Configuration& configuration, const ConfiguredObject& object);
/// Reads the object and fits the configuration to it.
/// @throws std::invalid_argument, std::runtime_error naming the file or the setting; OutOfMemory; Stopped
ConfiguredObject load_object(Configuration& configuration, const std::stop_token& stop = {});

/// Where to begin: with the source's first frame, or where it says, else where a robot of its own is, else as
/// configured.
View start_view(const Configuration& configuration, const SourceDescription& source, const Robot* robot);
/// The ideal camera, which stays in its working volume; one that goes through a recording has none.
/// @throws std::invalid_argument if the start lies outside
std::unique_ptr<Robot> configured_robot(const Configuration& configuration, const View& start);
VoxelGrid configured_region(const Configuration& configuration);
/// The source's region, if it has one and the configuration gives none.
VoxelGrid configured_region(const Configuration& configuration, const SourceDescription& source);
/// A recording's frames, if the source is one. `notice`, if given, hears what was passed over among views that are
/// read.
std::shared_ptr<const CandidateGenerator> configured_candidates(
    const Configuration& configuration, const SourceDescription& source,
    const std::function<void(const std::string&)>& notice = {});
/// The points of an object that coverage is a share of.
SurfaceSamples evaluation_samples(const Configuration& configuration, const TriangleMesh& object);
/// @throws std::invalid_argument naming the file if the object reaches beyond the region of interest.
void require_within_region(const TriangleMesh& object, const Configuration& configuration,
                           const std::filesystem::path& file);
/// The rays that score a view.
RayBundle scoring_rays(const Configuration& configuration, const PinholeCamera& camera);
/// Those that score the best ones again: a whole number of times as many each way, as far as there are pixels; none if
/// they would be the same.
RayBundle finer_rays(const Configuration& configuration, const PinholeCamera& camera);
/// How far behind a surface voxels are marked [m]: as configured, or what the reference code has.
double occlusion_distance(const Configuration& configuration);
/// d_max of proximity count [voxels].
double occlusion_reach(const Configuration& configuration);
/// What is known before the first view, for a planner of these needs.
Knowledge nothing_known(const Configuration& configuration, const VoxelGrid& region, const PolicyNeeds& needs);

}  // namespace nextview
