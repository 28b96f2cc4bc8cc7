#pragma once
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"

/// Closed meshes for the tests of the ground truth, made from formulas [m].
namespace nextview::closed_meshes {

inline TriangleMesh box(const Vector3& lower, const Vector3& upper) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(
        Vector3(k & 1 ? upper.x() : lower.x(), k & 2 ? upper.y() : lower.y(), k & 4 ? upper.z() : lower.z())
            .cast<float>());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline TriangleMesh octahedron(const Vector3& centre, double radius) {
  TriangleMesh mesh;
  for (int k = 0; k < 6; ++k)
    mesh.vertices.push_back((centre + (k % 2 ? -radius : radius) * Vector3::Unit(k / 2)).cast<float>());
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

inline TriangleMesh sphere(const Vector3& centre, double radius, int subdivisions) {
  TriangleMesh mesh = octahedron(Vector3::Zero(), 1.0);
  for (int s = 0; s < subdivisions; ++s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (auto& v : mesh.vertices) v = (centre + radius * v.cast<double>()).cast<float>();
  return mesh;
}

inline TriangleMesh torus(const Vector3& centre, double radius, double tube, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across,
                   r = radius + tube * std::cos(v);
      mesh.vertices.push_back((centre + Vector3(r * std::cos(u), r * std::sin(u), tube * std::sin(v))).cast<float>());
      const auto at = [&](int a, int b) { return std::uint32_t(a % around * across + b % across); };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

inline void turn(TriangleMesh& mesh, double angle) {
  const Eigen::AngleAxisd rotation(angle, Vector3(0.4, -0.3, 0.8).normalized());
  for (auto& v : mesh.vertices) v = (rotation * v.cast<double>()).cast<float>();
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto offset = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + offset, b + offset, c + offset});
}

/// Voxels of 1 cm around the origin, with sides of different lengths.
inline VoxelGrid grid_around_origin() {
  VoxelGrid grid;
  grid.first = {-13, -11, -12};
  grid.size = {27, 23, 25};
  return grid;
}

/// Objects of every kind, none aligned with the grid.
inline std::vector<std::pair<const char*, TriangleMesh>> objects() {
  std::vector<std::pair<const char*, TriangleMesh>> all;
  all.emplace_back("sphere", sphere({0.0013, -0.0021, 0.0037}, 0.0871, 2));
  all.emplace_back("box", box({-0.0613, -0.0427, -0.0771}, {0.0537, 0.0671, 0.0433}));
  all.emplace_back("tilted box", box({-0.0613, -0.0427, -0.0171}, {0.0537, 0.0671, 0.0033}));
  turn(all.back().second, 0.7);
  all.emplace_back("tilted torus", torus({0.0041, 0.0029, -0.0017}, 0.0633, 0.0287, 24, 12));
  turn(all.back().second, 1.1);
  all.emplace_back("thin sheet", box({-0.0731, -0.0613, 0.0141}, {0.0677, 0.0559, 0.0163}));
  all.emplace_back("partly outside", sphere({0.1013, 0.0571, -0.0933}, 0.0697, 2));
  return all;
}

}  // namespace nextview::closed_meshes
