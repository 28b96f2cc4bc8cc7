#pragma once
#include <cstdint>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// `count` points spread over the surface in proportion to area (stratified along the cumulated area), the same for the
/// same seed.
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> points;   ///< [m, world]
  std::vector<std::uint32_t> triangles;  ///< the triangle of each point
};

SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace nextview
