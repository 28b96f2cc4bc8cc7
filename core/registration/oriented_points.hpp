#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// A point of a surface, and where its outside is: towards the camera that saw it.
struct OrientedPoint {
  Vector3 position;     ///< [m, world]
  Vector3 normal;       ///< unit length
  double weight = 1.0;  ///< how many points it stands for
};

/// A scan's hits thinned to one point a cube of edge `spacing` [m], with the normals of the planes through their
/// neighbours. Points without enough neighbours are left out. The same for the same input. @throws Stopped
std::vector<OrientedPoint> oriented_points(const Scan& scan, double spacing, const std::stop_token& stop = {});

/// Several scans' points thinned together, scan by scan: in each cube one point for each side of a wall that was seen
/// in it.
class MergedPoints {
 public:
  using Cell = std::array<std::int64_t, 3>;  ///< of a cube: its number along each axis

  explicit MergedPoints(double spacing) : spacing_(spacing) {}  ///< edge of a cube [m]
  void add(const std::vector<OrientedPoint>& scan);
  std::vector<OrientedPoint> points() const;

 private:
  double spacing_;
  std::map<Cell, std::vector<std::size_t>> at_;  ///< indices of sums_
  std::vector<OrientedPoint> sums_;              ///< positions and normals are sums, by weight
};

}  // namespace nextview
