#include "core/mesh/lattice_solid.hpp"

#include <cassert>

#include "core/mesh/weld.hpp"

namespace nextview {
namespace {

using Corners = std::vector<Eigen::Vector3f>;  // three a triangle
using Triangle2 = std::array<Eigen::Vector2d, 3>;

/// A point of a plane across `axis`; its coordinates belong to the axes that follow.
Eigen::Vector3f lift(const Eigen::Vector2d& point, int axis, double height) {
  Eigen::Vector3d lifted;
  lifted[axis] = height;
  lifted[(axis + 1) % 3] = point.x();
  lifted[(axis + 2) % 3] = point.y();
  return lifted.cast<float>();
}

/// The rectangle less the hole, counter-clockwise. `rectangle` has one corner a quadrant, as outlines have a quarter of
/// theirs.
std::vector<Triangle2> around_hole(const std::array<Eigen::Vector2d, 4>& rectangle, const LatticeSolid::Outline& hole) {
  std::vector<Triangle2> triangles;
  const std::size_t count = hole.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count, quadrant = i * 4 / count, next_quadrant = next * 4 / count;
    triangles.push_back({rectangle[quadrant], hole[next], hole[i]});
    if (quadrant != next_quadrant) triangles.push_back({rectangle[quadrant], rectangle[next_quadrant], hole[next]});
  }
  return triangles;
}

void add_face(const std::vector<Triangle2>& triangles, int axis, double height, bool upper, Corners& corners) {
  for (const auto& [a, b, c] : triangles)
    for (const Eigen::Vector2d& point : {a, upper ? b : c, upper ? c : b}) corners.push_back(lift(point, axis, height));
}

/// The hole's wall, seen from inside the hole.
void add_wall(const LatticeSolid::Outline& hole, int axis, double low, double high, Corners& corners) {
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Eigen::Vector2d &here = hole[i], &next = hole[(i + 1) % hole.size()];
    for (const auto& corner : {lift(here, axis, low), lift(here, axis, high), lift(next, axis, high),  //
                               lift(here, axis, low), lift(next, axis, high), lift(next, axis, low)})
      corners.push_back(corner);
  }
}

TriangleMesh join(const Corners& corners) {
  TriangleMesh mesh{corners, {}};
  for (std::uint32_t i = 0; i < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  return welded(mesh);
}

}  // namespace

LatticeSolid::LatticeSolid(std::array<std::vector<double>, 3> lines) : lines_(std::move(lines)) {
  for (int z = 0; z + 1 < static_cast<int>(lines_[2].size()); ++z)
    for (int y = 0; y + 1 < static_cast<int>(lines_[1].size()); ++y)
      for (int x = 0; x + 1 < static_cast<int>(lines_[0].size()); ++x) solid_[{x, y, z}] = true;
}

void LatticeSolid::clear(const Cell& first, const Cell& last) {
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) solid_.at({x, y, z}) = false;
}

void LatticeSolid::pierce(const Cell& cell, int axis, const Outline& outline) {
  assert(solid(cell) && outline.size() % 4 == 0);
  holes_[cell] = {axis, outline};
}

bool LatticeSolid::solid(const Cell& cell) const {
  const auto found = solid_.find(cell);
  return found != solid_.end() && found->second;
}

void LatticeSolid::add_cell(const Cell& cell, Corners& corners) const {
  const auto hole = holes_.find(cell);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double u0 = lines_[u][cell[u]], u1 = lines_[u][cell[u] + 1], v0 = lines_[v][cell[v]],
                 v1 = lines_[v][cell[v] + 1];
    const std::array<Eigen::Vector2d, 4> rectangle = {{{u1, v1}, {u0, v1}, {u0, v0}, {u1, v0}}};
    const bool pierced = hole != holes_.end() && hole->second.axis == axis;
    const std::vector<Triangle2> face = pierced ? around_hole(rectangle, hole->second.outline)
                                                : std::vector<Triangle2>{{rectangle[0], rectangle[1], rectangle[2]},
                                                                         {rectangle[0], rectangle[2], rectangle[3]}};
    for (const bool upper : {false, true}) {
      Cell neighbour = cell;
      neighbour[axis] += upper ? 1 : -1;
      assert(!pierced || !solid(neighbour));
      if (!solid(neighbour)) add_face(face, axis, lines_[axis][cell[axis] + upper], upper, corners);
    }
    if (pierced) add_wall(hole->second.outline, axis, lines_[axis][cell[axis]], lines_[axis][cell[axis] + 1], corners);
  }
}

TriangleMesh LatticeSolid::surface() const {
  Corners corners;
  for (const auto& [cell, is_solid] : solid_)
    if (is_solid) add_cell(cell, corners);
  return join(corners);
}

}  // namespace nextview
