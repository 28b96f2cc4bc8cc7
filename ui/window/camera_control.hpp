#pragma once
#include <numbers>

#include "core/view/pose.hpp"

class vtkRenderer;

namespace nextview {

/// How a pointer moves the camera of a scene in which z is up, with vanishing points or without. Lengths in pixels, x
/// to the right, y downwards.

/// Straight from above, the z axis would be no direction [rad].
inline constexpr double max_elevation = 89 * std::numbers::pi / 180;

/// Turns around a point, which stays where it is in the picture, as if the scene were grasped there.
void orbit(vtkRenderer& renderer, const Vector3& pivot, double x, double y);
/// The same by angles [rad]: the camera goes to the right and up.
void turn(vtkRenderer& renderer, const Vector3& pivot, double azimuth, double elevation);
/// Moves sideways; what lies as deep as a point stays under the pointer.
void pan(vtkRenderer& renderer, const Vector3& pivot, double x, double y);
/// Nearer to a point, which stays where it is in the picture, for positive steps.
void zoom(vtkRenderer& renderer, const Vector3& pivot, double steps);
/// Moves sideways until a point is in the middle.
void centre(vtkRenderer& renderer, const Vector3& point);

/// Where the scene is looked at from: T_world_camera.
Pose camera_pose(vtkRenderer& renderer);
/// Looks from there, at what is as far away as `target` [m, world], and `vertical_angle` [deg] wide.
void look_through(vtkRenderer& renderer, const Pose& T_world_camera, const Vector3& target, double vertical_angle);

}  // namespace nextview
