#pragma once
#include <cstdint>
#include <vector>

#include "core/map/voxel_grid.hpp"

namespace nextview {

/// The normal of a surface, within 18 degrees and in either sense: one of the ways from a voxel to those up to two
/// away. A byte, as there is one a voxel.
class CoarseNormal {
 public:
  static constexpr int farthest = 9;  ///< component of a way: that of the ways to all voxels on one side, added up

  /// The nearest to a way that is not zero; where several are, always the same. @pre no component beyond `farthest`
  static CoarseNormal along(const Eigen::Vector3i& way);

  const Vector3& direction() const { return directions[number_]; }  ///< unit
  /// Of the angle to a direction of unit length.
  double squared_cosine(const Vector3& direction_of_ray) const {
    const double cosine = direction().dot(direction_of_ray);
    return cosine * cosine;
  }

 private:
  /// Of each two opposite ones the one that comes last, x before y before z; the axes first.
  static const std::vector<Vector3> directions;

  std::uint8_t number_;  // without a value at first, so that large arrays need not be written twice
};

/// The area of new surface over the area across the rays that should meet it: so much more the flatter it is met. What
/// is to be expected where its normal is known no better than CoarseNormal knows it, and chances are as good as they
/// are.
struct SurfaceSlant {
  static constexpr double least = 0.0, most = 10.0;

  double edge_on = 2.1;  ///< where the normal lies across the ray
  double face_on = 1.1;  ///< where it lies along it

  double at(double squared_cosine) const { return edge_on + (face_on - edge_on) * squared_cosine; }
  SurfaceSlant times(double factor) const { return {factor * edge_on, factor * face_on}; }
  bool operator==(const SurfaceSlant&) const = default;
};

}  // namespace nextview
