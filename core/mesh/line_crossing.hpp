#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include "core/view/pose.hpp"

namespace nextview {

/// Whether the edge passes on one given side of a point of the plane, at the point's height. The edge is always taken
/// from its lower end, so the triangles on its two sides get the same answer, however it rounds; an even number of
/// triangles an edge then makes an even number of crossings a line: nothing leaks.
inline bool edge_passes(Eigen::Vector2d a, Eigen::Vector2d b, const Eigen::Vector2d& point) {
  if ((a.y() <= point.y()) == (b.y() <= point.y())) return false;
  if (a.y() > b.y()) std::swap(a, b);
  return (b.x() - a.x()) * (point.y() - a.y()) - (point.x() - a.x()) * (b.y() - a.y()) > 0.0;
}

/// Where a line parallel to an axis crosses the triangle: the coordinate along the axis, if it does. `at`: the line's
/// coordinates along the next axis and the one after it, in the order x, y, z, x, y.
inline std::optional<double> line_crossing(const std::array<Vector3, 3>& t, int axis, const Eigen::Vector2d& at) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto flat = [&](const Vector3& p) { return Eigen::Vector2d(p[u], p[v]); };
  const bool crossed = edge_passes(flat(t[0]), flat(t[1]), at) ^ edge_passes(flat(t[1]), flat(t[2]), at) ^
                       edge_passes(flat(t[2]), flat(t[0]), at);
  if (!crossed) return std::nullopt;
  const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (normal[axis] == 0.0) return low;
  const double rise = normal[u] * (at.x() - t[0][u]) + normal[v] * (at.y() - t[0][v]);
  return std::clamp(t[0][axis] - rise / normal[axis], low, high);
}

}  // namespace nextview
