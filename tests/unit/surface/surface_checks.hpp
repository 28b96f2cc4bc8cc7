#pragma once
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/surface/surface.hpp"
#include "core/view/pose.hpp"

/// What the tests of surfaces ask of a mesh, found in the plainest way.
namespace nextview::surface_checks {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline double signed_volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume +=
        mesh.vertices[a].cast<double>().dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) /
        6.0;
  return volume;
}

/// Corners - edges + triangles: 2 for each sphere, 0 for a torus.
inline long euler_characteristic(const TriangleMesh& mesh) {
  std::set<std::uint32_t> corners;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      corners.insert(t[k]);
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
  return long(corners.size()) - long(edges.size()) + long(mesh.triangles.size());
}

inline testing::AssertionResult indices_valid(const TriangleMesh& mesh) {
  for (const auto& t : mesh.triangles)
    for (const auto v : t)
      if (v >= mesh.vertices.size()) return testing::AssertionFailure() << "no vertex " << v;
  for (const auto& v : mesh.vertices)
    if (!v.allFinite()) return testing::AssertionFailure() << "a vertex is not finite";
  return testing::AssertionSuccess();
}

/// A closed surface whose normals point out.
inline testing::AssertionResult closed(const TriangleMesh& mesh) {
  if (auto valid = indices_valid(mesh); !valid) return valid;
  if (mesh.triangles.empty()) return testing::AssertionFailure() << "no triangles";
  const MeshTopology t = topology(mesh);
  if (!t.watertight() || t.misoriented_edges > 0) return testing::AssertionFailure() << t.summary();
  if (!(signed_volume(mesh) > 0.0)) return testing::AssertionFailure() << "volume " << signed_volume(mesh);
  return testing::AssertionSuccess();
}

/// As many uncertainties and marks as vertices; uncertainties finite, at least 0 and at most `largest` [m].
inline testing::AssertionResult complete(const Surface& surface, double largest) {
  const std::size_t count = surface.mesh.vertices.size();
  if (surface.uncertainty.size() != count || surface.seen.size() != count)
    return testing::AssertionFailure() << count << " vertices, " << surface.uncertainty.size() << " uncertainties, "
                                       << surface.seen.size() << " marks";
  for (const float u : surface.uncertainty)
    if (!(u >= 0.0f && u <= largest * 1.00001)) return testing::AssertionFailure() << "uncertainty " << u;
  for (const auto s : surface.seen)
    if (s > 1) return testing::AssertionFailure() << "seen " << int(s);
  if (surface.empty() == surface.why_empty.empty())
    return testing::AssertionFailure() << (surface.empty() ? "empty without" : "not empty with") << " a reason";
  return testing::AssertionSuccess();
}

/// Where the line from `origin` along the unit `direction` meets the mesh, and from which side: distances [m] of
/// triangles whose normal points against the line first, then of the others.
struct Crossings {
  std::vector<double> in, out;
};

inline Crossings crossings(const TriangleMesh& mesh, const Vector3& origin, const Vector3& direction) {
  Crossings result;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]].cast<double>(), ab = mesh.vertices[t[1]].cast<double>() - a,
                  ac = mesh.vertices[t[2]].cast<double>() - a;
    const Vector3 across = direction.cross(ac);
    const double determinant = ab.dot(across);
    if (std::abs(determinant) < 1e-18) continue;
    const double u = (origin - a).dot(across) / determinant;
    const double v = direction.dot((origin - a).cross(ab)) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
    (ab.cross(ac).dot(direction) < 0.0 ? result.in : result.out)
        .push_back(ac.dot((origin - a).cross(ab)) / determinant);
  }
  return result;
}

inline std::size_t piece_count(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> piece(mesh.vertices.size());
  for (std::uint32_t v = 0; v < piece.size(); ++v) piece[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& t : mesh.triangles) {
      const auto least = std::min({piece[t[0]], piece[t[1]], piece[t[2]]});
      for (const auto v : t) {
        changed |= piece[v] != least;
        piece[v] = least;
      }
    }
  }
  std::set<std::uint32_t> pieces;
  for (const auto& t : mesh.triangles) pieces.insert(piece[t[0]]);
  return pieces.size();
}

template <class Make>
auto with_threads(std::size_t threads, Make make) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return make();
}

}  // namespace nextview::surface_checks
