#pragma once
#include <string>

#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// Why a view from there would measure nothing of the object, or next to nothing: the camera is within the object, too
/// near, out of the sensor's range, or looks past it. Empty: it measures something.
std::string why_empty(const SessionSnapshot& session, const Pose& T_world_camera);

/// A view in the same direction from which the sensor does see the object: where the camera is, if it does from there,
/// or moved along its line of sight. Where it is, too, if nothing along that line would help.
struct PlacedView {
  Pose T_world_camera = Pose::Identity();
  double moved = 0.0;  ///< nearer [m]; negative: away
};
PlacedView within_sight(const SessionSnapshot& session, const Pose& T_world_camera);

}  // namespace nextview
