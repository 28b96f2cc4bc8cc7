#pragma once
#include <algorithm>
#include <vector>

#include "core/view/pose.hpp"
#include "tests/unit/gain/evidence_maps.hpp"

/// A block, measured all around, with bores whose bottoms no one has seen.
namespace nextview::drilled_block {

using Eigen::Vector3i;

inline constexpr double half = 0.15;  // its edge [m]

/// From the outside towards the block's middle.
struct Bore {
  Vector3 axis;                ///< unit, outward
  double radius, depth;        ///< from the block's face, along the axis [m]
  Vector3 centre = {0, 0, 0};  ///< a point of its axis

  /// How far from the middle a point of the axis lies where the bore comes out of the block.
  double mouth() const { return half / axis.cwiseAbs().maxCoeff(); }
  /// The last point that is free, but for half a voxel.
  Vector3 bottom() const { return centre + (mouth() - depth) * axis; }
  bool contains(const Vector3& point) const {
    const Vector3 from = point - centre;
    const double along = from.dot(axis);
    return along > mouth() - depth && (from - along * axis).norm() < radius;
  }
};

/// Voxels of 1 cm in a region of 1 m, in whose middle the block stands. Its inside is not measured.
inline evidence_maps::MadeMap block(const std::vector<Bore>& bores) {
  evidence_maps::MadeMap made(VoxelGrid{0.01, Vector3i::Constant(-50), Vector3i::Constant(100)});
  made.for_each({25, 25, 25}, {74, 74, 74}, [&](const Vector3i& cell) {
    const Vector3 point = made.map.grid().centre(made.map.grid().index(cell));
    const double outside = point.cwiseAbs().maxCoeff() - half;
    const auto in = [&](const Bore& bore) { return bore.contains(point); };
    const bool is_bored = std::ranges::any_of(bores, in);
    // Walls are seen, bottoms are not.
    const auto beside = [&](const Bore& bore) {
      Bore wall = bore;
      wall.radius += 0.015;
      return wall.contains(point);
    };
    if (outside > 0.0 || is_bored) return made.set(cell, -1.5);
    if (outside > -0.01 || std::ranges::any_of(bores, beside)) made.set(cell, 1.5);
  });
  return made;
}

}  // namespace nextview::drilled_block
