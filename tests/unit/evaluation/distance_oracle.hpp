#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pose.hpp"

/// Distances to a mesh the slow way, every triangle in turn, by other formulas than those under test.
namespace nextview::distance_oracle {

/// By nested search: the distance to a point that moves along a line is convex, and so is its least over the other
/// line.
inline double to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const auto least = [](auto f) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      (f(left) < f(right) ? high : low) = f(left) < f(right) ? right : left;
    }
    return f(0.5 * (low + high));
  };
  return std::sqrt(least([&](double u) {
    const Vector3 from = a + u * (b - a), to = a + u * (c - a);
    const double length = (to - from).squaredNorm();
    const double v = length > 0.0 ? std::clamp((p - from).dot(to - from) / length, 0.0, 1.0) : 0.0;
    return (from + v * (to - from) - p).squaredNorm();
  }));
}

/// How many times the mesh winds around the point (solid angles, Van Oosterom and Strackee 1983): of a closed mesh with
/// normals outwards 1 inside and 0 outside.
inline double winding_number(const Vector3& p, const TriangleMesh& mesh) {
  double angle = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]].cast<double>() - p, b = mesh.vertices[t[1]].cast<double>() - p,
                  c = mesh.vertices[t[2]].cast<double>() - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

inline double unsigned_distance(const Vector3& p, const TriangleMesh& mesh) {
  double nearest = INFINITY;
  for (const auto& t : mesh.triangles)
    nearest = std::min(nearest, to_triangle(p, mesh.vertices[t[0]].cast<double>(), mesh.vertices[t[1]].cast<double>(),
                                            mesh.vertices[t[2]].cast<double>()));
  return nearest;
}

inline double signed_distance(const Vector3& p, const TriangleMesh& mesh) {
  return (std::abs(winding_number(p, mesh)) > 0.5 ? -1.0 : 1.0) * unsigned_distance(p, mesh);
}

}  // namespace nextview::distance_oracle
