#pragma once
#include "core/view/pose.hpp"

class vtkRenderer;

namespace nextview {

/// How a pointer moves the camera of a scene in which z is up. Lengths in pixels, x to the right, y downwards.

/// Turns around the focal point, as if the scene were grasped.
void orbit(vtkRenderer& renderer, double x, double y);
/// Moves sideways; what lies at the focal point's depth stays under the pointer.
void pan(vtkRenderer& renderer, double x, double y);
/// Nearer for positive steps.
void zoom(vtkRenderer& renderer, double steps);

/// Where the scene is looked at from: T_world_camera.
Pose camera_pose(vtkRenderer& renderer);
/// Looks from there, at what is as far away as `target` [m, world], and `vertical_angle` [deg] wide.
void look_through(vtkRenderer& renderer, const Pose& T_world_camera, const Vector3& target, double vertical_angle);

}  // namespace nextview
