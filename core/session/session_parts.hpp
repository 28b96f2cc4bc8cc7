#pragma once
#include <memory>
#include <string>

#include "core/gain/map_rays.hpp"
#include "core/session/configuration.hpp"
#include "core/session/map_refinement.hpp"

namespace nextview {

// What a configuration says that a session is made of.

/// @throws std::invalid_argument naming the field and its bounds.
Configuration validated(Configuration configuration);

/// The same configuration. @throws OutOfMemory if the map, the camera's images or the views' clouds will not fit.
Configuration affordable(Configuration configuration);
/// One line that says what took the memory of a scan that has none left, and what to do.
std::string not_enough_memory(const Configuration& configuration);

Pose configured_start_view(const Configuration& configuration);
VoxelGrid configured_region(const Configuration& configuration);
/// @throws std::invalid_argument naming the file if the object reaches beyond the region of interest.
void require_within_region(const TriangleMesh& object, const Configuration& configuration,
                           const std::filesystem::path& file);
/// The rays that score a view.
RayBundle scoring_rays(const Configuration& configuration, const PinholeCamera& camera);
/// Rays through a map; the voxels must outlive them.
MapRays configured_rays(const Configuration& configuration, const VoxelGrid& grid, std::span<const Voxel> voxels);
/// Null unless the semantics are the reference's.
std::unique_ptr<ReferenceMap> make_reference_map(const Configuration& configuration);
/// How far behind a surface voxels are marked as occluded [m] (Isler et al. 2016).
constexpr double occlusion_distance = 0.3;
/// d_max of proximity count [voxels].
double occlusion_reach(const Configuration& configuration);
/// Null unless the policy needs the Gibbs map.
std::unique_ptr<MapRefinement> make_refinement(const Configuration& configuration);

}  // namespace nextview
