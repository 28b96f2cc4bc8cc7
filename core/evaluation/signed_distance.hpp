#pragma once
#include "core/evaluation/mesh_distance.hpp"

namespace nextview {

/// The distance from points to a mesh's surface, negative inside. Safe to use from several threads at once.
///
/// Inside is decided as in ground_truth: by the even-odd rule, so turned triangles and normals that point inwards do
/// not matter, by a vote, so holes hardly do. Of the six half-lines from the point along the axes, each that crosses
/// the surface an odd number of times says 'inside'; four must. (A line through a hole has one half that says 'inside'
/// and one that says 'outside': it has no say. Winding numbers would close large holes more smoothly, but fail on
/// turned triangles. Where closed parts overlap, the even-odd rule calls the common part outside.)
class SignedDistance {
 public:
  /// @throws std::invalid_argument if the mesh has no triangles.
  explicit SignedDistance(const TriangleMesh& mesh);

  /// Distance from a point [m, world] to the nearest point of any triangle [m], negative inside, 0 on the surface.
  double operator()(const Eigen::Vector3f& point) const;

  bool inside(const Eigen::Vector3f& point) const;

  /// Without the sign.
  const MeshDistance& distance() const { return distance_; }

 private:
  int half_lines_inside(int axis, const Eigen::Vector3f& point) const;

  TriangleMesh mesh_;
  MeshDistance distance_;
};

}  // namespace nextview
