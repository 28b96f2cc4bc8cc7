#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <vector>

#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// Points of a surface, and its unit normal at each; it has two sides.
struct SampledSurface {
  std::span<const Eigen::Vector3f> points, normals;  ///< [m, world]
};

/// Seen, however far apart the image's pixels lie on the surface.
inline constexpr double any_slant = std::numeric_limits<double>::infinity();

/// How far off a surface may be, looked at under an angle of this cosine from its normal, that each point of it has a
/// pixel of the image within `d_reg` [m].
double resolved_range(const PinholeCamera& camera, double cosine, double d_reg);

/// Of the `asked` samples, by number, those that a perfect camera sees from a pose: in its image and ranges, not too
/// slanted for it, nor too far for `d_reg` (resolved_range), nothing in between. @throws Stopped
std::vector<std::uint32_t> visible_samples(const SampledSurface& surface, const MeshRayCaster& scene,
                                           const DepthCamera& camera, const Pose& T_world_camera,
                                           std::span<const std::uint32_t> asked, double d_reg,
                                           const std::stop_token& stop = {});

}  // namespace nextview
