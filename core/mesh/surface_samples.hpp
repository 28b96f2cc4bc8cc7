#pragma once
#include <cstdint>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// Points of a surface.
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> points;   ///< [m, world]
  std::vector<std::uint32_t> triangles;  ///< the triangle of each point
};

/// The vertices of a mesh, each with one of its triangles; those that no triangle has are left out.
SurfaceSamples vertex_samples(const TriangleMesh& mesh);

/// `count` points spread over the surface in proportion to area (stratified along the cumulated area), the same for the
/// same seed. @throws std::invalid_argument if the mesh has no area
SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace nextview
