#pragma once
#include "ui/commands/presentation.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// The way of the scene's camera during a flight, from where it stands when this is made: on a sphere around what it
/// looks at, which moves along a straight line.
class CameraCourse {
 public:
  /// Leaves the camera where it is.
  CameraCourse(SceneView& view, const CameraFlight& flight);
  /// Puts the camera where it is after this share of the way.
  void stand(SceneView& view, double share) const;
  /// The flight that ends as the camera stands now.
  static CameraFlight flight_to_here(SceneView& view);

 private:
  struct Place {
    Vector3 focus = Vector3::Zero();    ///< what it looks at [m, world]
    double azimuth = 0, elevation = 0;  ///< of the camera, seen from there [rad]
    double distance = 1;                ///< [m]
    double angle = 30;                  ///< that it sees, vertically [deg]
  };
  static Place place_of(SceneView& view);

  Scene::Stand end_;
  Place from_, to_;
};

}  // namespace nextview
