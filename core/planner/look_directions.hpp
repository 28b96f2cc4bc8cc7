#pragma once
#include <vector>

#include "core/gain/new_surface.hpp"

namespace nextview {

/// From where in a map places can be looked at. Safe to use from several threads.
class LookDirections {
 public:
  explicit LookDirections(const NewSurfaceField& field);

  /// The directions from a place in which rays are likely to get out unhindered, towards a camera.
  struct Open {
    std::vector<Vector3> directions;  ///< evenly spread over the open ones
    /// At most two of them, the one with more about it first: of a bore its axis, of an open face its normal.
    std::vector<Vector3> axes;
  };
  /// Follows few rays outward, and many where few of those get out. `place` in metres, world.
  Open from(const Vector3& place) const;

 private:
  bool gets_out(const Vector3& place, const Vector3& direction) const;

  const NewSurfaceField& field_;
  std::vector<Vector3> few_, many_;
};

/// Places where the map ends and surface is likely to go on: the middles of `count` voxels beside free ones, drawn by
/// their chance of new surface; none if there is no such voxel. @param shift from 0 to 1: each draws others
std::vector<Vector3> frontier_places(const NewSurfaceField& field, const SurfaceEvidence& evidence, std::size_t count,
                                     double shift);

}  // namespace nextview
