#pragma once
#include <optional>
#include <span>

#include "core/view/pose.hpp"

namespace nextview {

/// A circle in space, and how well points lie on it.
struct FittedCircle {
  Vector3 centre = Vector3::Zero(), normal = Vector3::UnitZ();  ///< [m, world], unit length
  double radius = 0.0;                                          ///< [m]
  double residual = 0.0;   ///< root mean square distance of the points to it, across its axis [m]
  std::size_t points = 0;  ///< that it was fitted to; 0: it goes through the three that were picked
  bool doubtful = false;   ///< the points around it know of no such rim
};

/// The circle through three points; none if they lie on a line.
std::optional<FittedCircle> circle_through(const Vector3& a, const Vector3& b, const Vector3& c);

/// The rim of a bore, or of a pin, near a circle that was picked by hand: laid on the flat face around it, and as wide
/// as a cylinder through the wall that begins there, from a third of the radius to a whole one deep. Points of the face
/// have no part in that. Where there is no such wall (a hole in a sheet), as wide as what lies within a tenth of the
/// rim. As it was if fewer than twenty points tell.
/// It is doubtful if the face goes on across the rim, if the wall's points lie far off the cylinder, or beside less
/// than a third of its round.
FittedCircle fitted(const FittedCircle& circle, std::span<const Eigen::Vector3f> cloud);

}  // namespace nextview
