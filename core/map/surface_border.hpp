#pragma once
#include <vector>

#include "core/map/scanned_surface.hpp"

namespace nextview {

/// Where what was scanned of a surface ends: around a point of its border more than a third of the tangent plane is
/// empty (the angle criterion; Bendels, Schnabel and Klein 2006).
struct SurfaceBorder {
  struct Point {
    Eigen::Vector3f at, outward;  ///< [m, world], and the middle of what is empty, a unit vector
  };
  std::vector<Point> points;
  double spacing = 0.0;                 ///< how much of the border each point stands for [m]
  std::vector<Eigen::Vector3f> within;  ///< the surface: a point a cell, if no stray ones are in it [m, world]
};

/// Points are looked at that are the surface's radius apart, the middle of each of its cells or of every so-many-th:
/// fewer than twice `most`. The same on any number of threads.
SurfaceBorder surface_border(const ScannedSurface& surface, std::size_t most = 20'000);

/// Where what was scanned ends and the surface may go on.
struct OpenBorder {
  std::vector<Eigen::Vector3f> beyond;       ///< the border, past it [m, world]
  double spacing = 0.0;                      ///< SurfaceBorder::spacing
  std::vector<Eigen::Vector3f> within = {};  ///< SurfaceBorder::within
  double length = 0.0;  ///< of it, without what may be a sheet that ends in free space within a voxel [m]
};

/// As far as a point's surroundings reach [m].
double border_reach(const ScannedSurface& surface);

}  // namespace nextview
