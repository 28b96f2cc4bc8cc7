#pragma once
#include <string>

#include "core/session/session.hpp"

namespace nextview {

/// steps.csv: a row per view, with what it saw, what it cost and how good the map was after it.
std::string steps_csv(const Session& session);

// The views that were taken, in their order: T_world_camera in metres, the camera looking along its z axis, y down.

/// views.csv: position and quaternion.
std::string views_csv(const Session& session);
/// An array of objects: the matrix by rows, position, quaternion and look direction.
std::string views_json(const Session& session);
/// For robot programs: a comment, then a line "x y z qx qy qz qw" per pose.
std::string views_txt(const Session& session);

}  // namespace nextview
