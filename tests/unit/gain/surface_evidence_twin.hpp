#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview::evidence_maps {

/// The features written down from their comments, by comparing all voxels of a map.
struct EvidenceTwin {
  using Kind = SurfaceEvidence::Kind;

  explicit EvidenceTwin(const MadeMap& made) : grid(made.map.grid()), voxels(made.map.voxels()) {
    Vector3i low = grid.size, high = -Vector3i::Ones();
    MadeMap::for_each(Vector3i::Zero(), grid.size - Vector3i::Ones(), [&](const Vector3i& cell) {
      if (kind(cell) == Kind::occupied) low = low.cwiseMin(cell), high = high.cwiseMax(cell);
      of_kind[std::size_t(kind(cell))].push_back(cell);
    });
    size = (high - low + Vector3i::Ones()).cast<double>().norm();
  }
  Kind kind(const Vector3i& cell) const {
    const Voxel& voxel = voxels.at(cell.x(), cell.y(), cell.z());
    return !voxel.measured ? Kind::unmeasured : voxel.probability >= 0.5f ? Kind::occupied : Kind::free;
  }
  double ln_distance(const Vector3i& cell, Kind to) const {
    double nearest = std::numeric_limits<double>::max();
    for (const Vector3i& other : of_kind[std::size_t(to)])
      nearest = std::min(nearest, (other - cell).cast<double>().norm());
    return std::log(nearest / size);
  }
  int around(const Vector3i& cell, Kind wanted) const {
    int count = 0;
    MadeMap::for_each(cell - Vector3i::Ones(), cell + Vector3i::Ones(), [&](const Vector3i& other) {
      count += other != cell && grid.contains(other) && kind(other) == wanted;
    });
    return count;
  }
  double outside(const Vector3i& cell) const {
    double farthest = -1e9;
    MadeMap::for_each({-1, -1, -1}, {1, 1, 1}, [&](const Vector3i& towards) {
      if (towards.squaredNorm() != 1 && towards.squaredNorm() != 2) return;
      int highest = std::numeric_limits<int>::min();
      for (const Vector3i& other : of_kind[std::size_t(Kind::occupied)])
        highest = std::max(highest, towards.dot(other));
      farthest = std::max(farthest, double(towards.dot(cell) - highest) / towards.cast<double>().norm());
    });
    return farthest;
  }

  VoxelGrid grid;
  VoxelBricks voxels;
  std::array<std::vector<Vector3i>, 3> of_kind;
  double size = 0.0;
};

}  // namespace nextview::evidence_maps
