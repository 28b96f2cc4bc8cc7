#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

using Vector3 = Eigen::Vector3d;

/// A pose is T_world_camera: it takes points of the camera frame (x right, y down, z forward, [m]) to the world.
using Pose = Eigen::Isometry3d;

/// A camera at `position` [m, world] whose z axis points at `target`; the world's z axis is up in its image.
/// Looking straight up or down, the world's y axis takes the place of up.
Pose look_at(const Vector3& position, const Vector3& target);

Pose make_pose(const Vector3& position, const Eigen::Quaterniond& orientation);

/// Farther from the world's origin along an axis is no camera [m, or the unit of what is read].
inline constexpr double farthest_pose = 1e6;

/// Whether a pose lies within farthest_pose, and its linear part is a rotation, give or take 1e-6.
bool is_pose(const Pose& pose);

/// Angle of the rotation that takes the orientation of `a` to that of `b` [rad], in [0, pi].
double rotation_angle(const Pose& a, const Pose& b);

/// A view as `x y z qx qy qz qw` (T_world_camera, [m]). @throws std::invalid_argument with the reason
Pose parse_view(const std::string& text);

/// The views file: lines that begin with # and a count alone on its line, either of which may be left out, then one
/// view a line as parse_view takes it.
/// @throws std::runtime_error naming the file, the line and what is wrong with it.
std::vector<Pose> read_views(const std::filesystem::path& file);

}  // namespace nextview
