#pragma once
#include <memory>

#include "core/evaluation/coverage.hpp"
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// Where a true surface has been observed and where it has been missed, to be painted on it: coverage (Eq. 17) at the
/// vertices of a finer mesh of it.
class MissedSurface {
 public:
  /// The mesh is subdivided until its edges are at most 1.5 d_reg [m] long, or as long as `max_triangles`
  /// (up to a million) make necessary. A mesh that has more than that already stays as it is.
  /// @throws std::invalid_argument if the mesh has no vertices or d_reg is not over 0.
  MissedSurface(const TriangleMesh& mesh, double d_reg, std::size_t max_triangles = 400'000);

  /// Observes the vertices within d_reg of any of these points. The order of calls does not matter.
  void add(const PointCloud& points) { coverage_.add(points); }

  std::shared_ptr<const TriangleMesh> mesh() const { return mesh_; }               ///< the finer one
  std::span<const std::uint8_t> observed() const { return coverage_.observed(); }  ///< one per vertex of mesh()
  double d_reg() const { return coverage_.d_reg(); }
  double longest_edge() const { return longest_edge_; }  ///< no edge of mesh() is longer [m]

 private:
  double longest_edge_;
  std::shared_ptr<const TriangleMesh> mesh_;
  SurfaceCoverage coverage_;
};

}  // namespace nextview
