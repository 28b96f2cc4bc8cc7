#pragma once
#include <span>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// The part of a viewport that the picture's contents must stay within, as a share of its width and height from each
/// side.
struct FrameMargins {
  double left = 0.04, right = 0.04, bottom = 0.04, top = 0.04;
};

/// Of many points those that stick out farthest in some direction [m, world], to frame them all by: within 1 % of their
/// largest extent. Empty if there are none.
std::vector<Vector3> extreme_points(std::span<const Eigen::Vector3f> points);

/// Moves a camera with a fixed orientation as near as it can while it sees all points.
/// `T_world_camera` gives the orientation (x right, y down, z forward), `vertical_angle` [rad] and `aspect` (width /
/// height) the perspective. Returns the camera centre [m, world].
/// @throws std::invalid_argument if there are no points or the margins leave no room.
Vector3 frame_points(const Eigen::Matrix3d& R_world_camera, double vertical_angle, double aspect,
                     const FrameMargins& margins, std::span<const Vector3> points);

/// Whether a camera there shows all points (and what lies between them) clear of the rectangle between `corner` and the
/// upper right corner of the viewport, or with `lower_left` that one; `corner` in shares of the viewport from the lower
/// left.
bool clears_corner(const Eigen::Matrix3d& R_world_camera, const Vector3& position, double vertical_angle, double aspect,
                   const Eigen::Vector2d& corner, std::span<const Vector3> points, bool lower_left = false);

}  // namespace nextview
