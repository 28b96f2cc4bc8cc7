#pragma once
#include <string>

#include "core/map/occupancy_map.hpp"

namespace nextview {

/// A map's measured voxels as OctoMap has them in a pruned tree, in the bytes that its files hold of one.
struct OctreeBytes {
  std::string bytes;
  std::size_t nodes = 0;  ///< inner ones too
};

/// Of .bt (`binary`: which voxels are occupied and which are free), or of .ot (log-odds). No tree is built: at its
/// finest it would take forty bytes a voxel, most of them for free space that pruning makes one leaf of.
OctreeBytes octree_bytes(const OccupancyMap& map, bool binary);

}  // namespace nextview
