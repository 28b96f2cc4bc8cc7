#pragma once

class vtkRenderer;

namespace nextview {

/// How a pointer moves the camera of a scene in which z is up. Lengths in pixels, x to the right, y downwards.

/// Turns around the focal point, as if the scene were grasped.
void orbit(vtkRenderer& renderer, double x, double y);
/// Moves sideways; what lies at the focal point's depth stays under the pointer.
void pan(vtkRenderer& renderer, double x, double y);
/// Nearer for positive steps.
void zoom(vtkRenderer& renderer, double steps);

}  // namespace nextview
