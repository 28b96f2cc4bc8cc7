#pragma once
#include <vector>

#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// A number at each point of a cubic lattice, x fastest, then y, then z.
struct ScalarField {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< points along each axis
  Vector3 origin = Vector3::Zero();                ///< of the first point [m, world]
  double spacing = 0.01;                           ///< between points [m]
  std::vector<float> values;

  std::size_t point_count() const { return std::size_t(size.x()) * std::size_t(size.y()) * std::size_t(size.z()); }
  std::size_t index(const Eigen::Vector3i& point) const {
    return (std::size_t(point.z()) * size.y() + point.y()) * size.x() + point.x();
  }
};

/// Where the field crosses `level`, by marching cubes: larger values are inside, normals point out. Every vertex lies
/// on an edge of the lattice and is there once. Watertight if no outermost point is inside. No value may be `level`
/// itself. The same on any number of threads.
/// @throws std::invalid_argument if the number of values is not the lattice's, or a size is negative.
TriangleMesh isosurface(const ScalarField& field, float level);

}  // namespace nextview
