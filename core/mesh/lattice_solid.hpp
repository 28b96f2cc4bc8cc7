#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// A solid of rectangular cells between lines along x, y and z, some of them pierced by a hole. Since all cells share
/// the lines, and a hole stays inside its cell, no corner ever lies on another triangle's edge: the surface is
/// watertight by construction.
class LatticeSolid {
 public:
  using Cell = std::array<int, 3>;
  /// Counter-clockwise seen against `axis`, in the coordinates of the axes that follow it (cyclically) [m]. A multiple
  /// of four corners, a quarter of them in each quadrant about the hole's centre, the first quadrant (+, +) first.
  using Outline = std::vector<Eigen::Vector2d>;

  /// All cells are solid. @param lines rising, along x, y and z [m]
  explicit LatticeSolid(std::array<std::vector<double>, 3> lines);

  /// Empties the cells from `first` to `last`, both included.
  void clear(const Cell& first, const Cell& last);
  /// Pierces a solid cell along `axis` (0: x, 1: y, 2: z); both its faces there must be free.
  void pierce(const Cell& cell, int axis, const Outline& outline);

  /// Normals point outwards.
  TriangleMesh surface() const;

 private:
  struct Hole {
    int axis;
    Outline outline;
  };
  bool solid(const Cell& cell) const;
  void add_cell(const Cell& cell, std::vector<Eigen::Vector3f>& corners) const;

  std::array<std::vector<double>, 3> lines_;
  std::map<Cell, bool> solid_;
  std::map<Cell, Hole> holes_;
};

}  // namespace nextview
