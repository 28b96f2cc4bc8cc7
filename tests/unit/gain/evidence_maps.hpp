#pragma once
#include <functional>
#include <random>
#include <vector>

#include "core/gain/surface_evidence.hpp"
#include "core/map/occupancy_map.hpp"

/// Small maps to tell where surface goes on.
namespace nextview::evidence_maps {

using Eigen::Vector3i;

struct MadeMap {
  explicit MadeMap(const VoxelGrid& grid) : map(grid) {}
  explicit MadeMap(const Vector3i& size, double resolution = 0.02) : map(VoxelGrid{resolution, -size / 2, size}) {}

  void set(const Vector3i& cell, double log_odds) {
    map.set_log_odds(map.grid().index(cell), static_cast<float>(log_odds));
  }
  /// All cells from `low` to `high`, inclusive.
  void set_box(const Vector3i& low, const Vector3i& high, double log_odds) {
    for_each(low, high, [&](const Vector3i& cell) { set(cell, log_odds); });
  }
  static void for_each(const Vector3i& low, const Vector3i& high, const std::function<void(const Vector3i&)>& visit) {
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) visit({x, y, z});
  }
  SurfaceEvidence evidence(double threshold = 0.5, double finest = SurfaceEvidence::finest_share,
                           const OpenBorder& border = {}) const {
    return {map.grid(), map.voxels(), map.voxels(), threshold, border, finest};
  }

  OccupancyMap map;
};

/// Measured voxels of all kinds, and unmeasured ones.
inline MadeMap random_map(std::mt19937& random, const Vector3i& size, double occupied, double unmeasured) {
  MadeMap made(size);
  std::uniform_real_distribution<double> uniform(0.0, 1.0), log_odds(0.01, 1.9);
  MadeMap::for_each(Vector3i::Zero(), size - Vector3i::Ones(), [&](const Vector3i& cell) {
    if (uniform(random) < unmeasured) return;
    made.set(cell, (uniform(random) < occupied ? 1.0 : -1.0) * log_odds(random));
  });
  return made;
}

/// Where a voxel of the whole map lies in the part of it that the evidence looks at.
inline Vector3i in_evidence(const SurfaceEvidence& evidence, const VoxelGrid& whole, const Vector3i& cell) {
  return cell + whole.first - evidence.grid().first;
}

/// The voxels that the evidence looks at, x fastest.
inline std::vector<Vector3i> cells(const SurfaceEvidence& evidence) {
  std::vector<Vector3i> all;
  for (std::uint32_t v = 0; v < evidence.grid().voxel_count(); ++v) all.push_back(evidence.grid().cell(v));
  return all;
}

}  // namespace nextview::evidence_maps
