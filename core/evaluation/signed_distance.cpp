#include "core/evaluation/signed_distance.hpp"

#include "core/mesh/line_crossing.hpp"

namespace nextview {

SignedDistance::SignedDistance(const TriangleMesh& mesh) : mesh_(mesh), distance_(mesh) {}

/// How many of the axis's two half-lines cross the surface an odd number of times.
int SignedDistance::half_lines_inside(int axis, const Eigen::Vector3f& point) const {
  const Vector3 p = point.cast<double>();
  const Eigen::Vector2d at(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  std::array<int, 2> crossings = {0, 0};
  distance_.for_each_along(axis, point, [&](std::uint32_t triangle) {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    const auto corner = [&](std::uint32_t i) -> Vector3 { return mesh_.vertices[i].cast<double>(); };
    const auto crossing = line_crossing({corner(a), corner(b), corner(c)}, axis, at);
    if (crossing) ++crossings[*crossing > p[axis]];
  });
  return crossings[0] % 2 + crossings[1] % 2;
}

bool SignedDistance::inside(const Eigen::Vector3f& point) const {
  int votes = half_lines_inside(0, point) + half_lines_inside(1, point);
  if (votes == 4 || votes < 2) return votes == 4;  // the third axis cannot change it
  votes += half_lines_inside(2, point);
  return votes >= 4;
}

double SignedDistance::operator()(const Eigen::Vector3f& point) const {
  const double distance = distance_(point);
  return distance > 0.0 && inside(point) ? -distance : distance;
}

}  // namespace nextview
