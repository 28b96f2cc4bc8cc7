#include "core/mesh/parts.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "core/mesh/lattice_solid.hpp"

namespace nextview {
namespace {

// Edges of openings lie off the multiples of 1 cm on purpose, each by another share of a voxel.
constexpr std::array<double, 4> widths = {0.010, 0.020, 0.030, 0.040};         // [m]
constexpr std::array<double, 4> columns = {-0.1877, -0.0661, 0.0596, 0.1722};  // centres of the openings along x [m]

/// The hole of an opening, in the coordinates of the two axes that follow its axis.
LatticeSolid::Outline outline(const Opening& opening, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Eigen::Vector2d centre(opening.centre[u], opening.centre[v]);
  if (opening.kind == Opening::Kind::slot) {
    const Eigen::Vector3d across = opening.axis.cross(opening.along).cwiseAbs();
    const Eigen::Vector3d half = 0.5 * (opening.length * opening.along.cwiseAbs() + opening.width * across);
    const double a = half[u], b = half[v];
    return {centre + Eigen::Vector2d(a, b), centre + Eigen::Vector2d(-a, b), centre + Eigen::Vector2d(-a, -b),
            centre + Eigen::Vector2d(a, -b)};
  }
  LatticeSolid::Outline corners;
  for (int i = 0; i < bore_corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / bore_corners;
    corners.push_back(centre + 0.5 * opening.width * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

void cut(LatticeSolid& solid, const LatticeSolid::Cell& cell, int axis, const Opening& opening, Part& part) {
  solid.pierce(cell, axis, outline(opening, axis));
  part.openings.push_back(opening);
}

Opening slot(double width, double length, double depth, const Eigen::Vector3d& centre, int axis, int along) {
  return {Opening::Kind::slot, width, length, depth, centre, Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(along)};
}

Opening bore(double width, double depth, const Eigen::Vector3d& centre, int axis) {
  return {Opening::Kind::bore,
          width,
          width,
          depth,
          centre,
          Eigen::Vector3d::Unit(axis),
          Eigen::Vector3d::Unit((axis + 1) % 3)};
}

/// The icosahedron's corners are (0, +-1, +-golden ratio) and its cyclic permutations; neighbours are 2 apart.
TriangleMesh icosahedron(std::vector<Eigen::Vector3d>& corners) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-std::numbers::phi, std::numbers::phi}) {
        Eigen::Vector3d corner = Eigen::Vector3d::Zero();
        corner[(axis + 1) % 3] = a;
        corner[(axis + 2) % 3] = b;
        corners.push_back(corner);
      }
  const auto neighbours = [&](std::uint32_t i, std::uint32_t j) { return (corners[i] - corners[j]).norm() < 2.1; };
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!neighbours(i, j) || !neighbours(j, k) || !neighbours(k, i)) continue;
        const bool outwards = corners[i].dot(corners[j].cross(corners[k])) > 0.0;
        mesh.triangles.push_back({i, outwards ? j : k, outwards ? k : j});
      }
  return mesh;
}

/// Puts a corner in the middle of every edge.
void divide(TriangleMesh& mesh, std::vector<Eigen::Vector3d>& corners) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(corners.size()));
    if (is_new) corners.push_back((corners[i] + corners[j]).normalized());
    return found->second;
  };
  std::vector<std::array<std::uint32_t, 3>> divided;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    divided.insert(divided.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = divided;
}

}  // namespace

Part slotted_plate() {
  constexpr double thickness = 0.03;
  LatticeSolid solid(
      {{{-0.25, -0.125, -0.005, 0.115, 0.25}, {-0.153, -0.0273, 0.153}, {-thickness / 2, thickness / 2}}});
  Part part{"slotted_plate", {}, {}};
  for (int i = 0; i < 4; ++i)
    cut(solid, {i, 1, 0}, 2, slot(widths[i], 0.12, thickness, {columns[i], 0.0716, 0.0}, 2, 1), part);
  for (int i = 0; i < 4; ++i) cut(solid, {i, 0, 0}, 2, bore(widths[i], thickness, {columns[i], -0.0837, 0.0}, 2), part);
  part.mesh = solid.surface();
  return part;
}

Part slotted_housing() {
  constexpr double wall = 0.02, wall_centre = 0.1735;
  LatticeSolid solid(
      {{{-0.25, -0.23, -0.125, -0.005, 0.115, 0.23, 0.25},
        {-wall_centre - wall / 2, -wall_centre + wall / 2, wall_centre - wall / 2, wall_centre + wall / 2},
        {-0.157, -0.137, 0.157}}});
  solid.clear({1, 1, 1}, {4, 1, 1});
  Part part{"slotted_housing", {}, {}};
  for (int i = 0; i < 4; ++i)
    cut(solid, {i + 1, 0, 1}, 1, slot(widths[i], 0.15, wall, {columns[i], -wall_centre, 0.0124}, 1, 2), part);
  for (int i = 0; i < 4; ++i)
    cut(solid, {i + 1, 2, 1}, 1, bore(widths[i], wall, {columns[i], wall_centre, 0.0124}, 1), part);
  part.mesh = solid.surface();
  return part;
}

Part sphere_part() {
  std::vector<Eigen::Vector3d> corners;
  TriangleMesh mesh = icosahedron(corners);
  for (Eigen::Vector3d& corner : corners) corner.normalize();
  for (int i = 0; i < 5; ++i) divide(mesh, corners);
  for (const Eigen::Vector3d& corner : corners) mesh.vertices.push_back((0.25 * corner).cast<float>());
  return {"sphere", mesh, {}};
}

Part box_part() { return {"box", LatticeSolid({{{-0.25, 0.25}, {-0.1655, 0.1655}, {-0.1235, 0.1235}}}).surface(), {}}; }

}  // namespace nextview
