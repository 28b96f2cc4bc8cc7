#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/config/configuration.hpp"
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// What makes no sense of a set-up, before a view is wasted on it: one line each with the numbers and the setting to
/// change. Cameras inside the object, or too near to it or too far for the sensor; views that have next to nothing of
/// it in their image; scoring rays that end before it; voxels as coarse as the object. Nearly always none. `object` as
/// load_mesh has placed it [m, world], of at least one triangle; the start view is looked at beside the candidates.
std::vector<std::string> setup_warnings(const Configuration& configuration, const TriangleMesh& object,
                                        std::span<const Pose> candidates);

}  // namespace nextview
