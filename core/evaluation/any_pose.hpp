#pragma once
#include "core/evaluation/visible_samples.hpp"
#include "core/progress/progress.hpp"

namespace nextview {

/// One a sample, 1: a camera could cover it at `d_reg` [m] from some pose. Poses are drawn from a seed of their own,
/// the same for every scan; each looks at a sample that none before it saw, in a direction in which that lies open: the
/// camera can back out the way it looks. No sample is nearer to a pose than the camera's least range, so none is inside
/// the object. What it sees, it sees in range and not at too much of a slant for d_reg (visible_samples).
/// The same on any number of threads. @throws Stopped
std::vector<std::uint8_t> seen_from_any_pose(const SampledSurface& surface, const MeshRayCaster& scene,
                                             const DepthCamera& camera, double d_reg, const Progress& progress = {},
                                             const std::stop_token& stop = {});

/// How many poses that is, at most.
inline constexpr std::size_t any_poses = 2000;

}  // namespace nextview
