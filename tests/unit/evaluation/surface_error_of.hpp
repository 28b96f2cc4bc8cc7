#pragma once
#include "core/evaluation/surface_error.hpp"

namespace nextview {

inline constexpr double mm = 1e-3;

/// A surface of which everything has been seen.
inline Surface seen_surface(const TriangleMesh& mesh) {
  Surface surface;
  surface.mesh = mesh;
  surface.uncertainty.assign(mesh.vertices.size(), 0.001f);
  surface.seen.assign(mesh.vertices.size(), 1);
  return surface;
}

/// Against all of the true mesh, of which everything can be seen.
inline SurfaceError surface_error_of(const Surface& surface, const TriangleMesh& truth,
                                     const SurfaceErrorOptions& options = {}) {
  const SurfaceSamples samples = sample_surface(truth, 20'000, 7);
  const std::vector<std::uint8_t> visible(samples.points.size(), 1);
  return surface_error(surface, SignedDistance(truth), samples, visible, options).value();
}

}  // namespace nextview
