#pragma once
#include <string>

#include "core/session/session.hpp"

namespace nextview {

/// How tables say the unit of gains: with the column's name where one planner expected them all, in a last column of
/// its own where the gain was changed between views to one of another unit.
class GainColumn {
 public:
  explicit GainColumn(const Session& session);
  std::string name() const { return mixed_ ? "gain" : "gain[" + unit_ + "]"; }
  std::string unit_name() const { return mixed_ ? ",gain_unit" : ""; }
  std::string unit(const std::string& of_row) const { return mixed_ ? "," + of_row : ""; }

 private:
  std::string unit_;  ///< the present planner's
  bool mixed_;
};

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
