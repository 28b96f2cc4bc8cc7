#pragma once
#include "ui/appearance/styles.hpp"
#include "ui/appearance/voxel_filter.hpp"

namespace nextview {

enum class MapChoice { conventional, gibbs };

/// What of a session the scene shows, and how.
struct LayerChoice {
  bool object = true, octree = true, views = true, rays = true;
  bool cloud = false;  ///< within the voxels it would be specks
  bool region = false, missed = false;
  bool all_candidates = false;  ///< not only the best ones
  bool legends = true;
  MeshStyle object_style = MeshStyle::ghost;
  CloudColouring cloud_colouring = CloudColouring::single;
  MapChoice map = MapChoice::conventional;
  VoxelColouring colouring = VoxelColouring::by_class;
  VoxelFilter voxels;
  bool ranges_locked = false;  ///< colour ranges stay as they were when this was switched on
};

}  // namespace nextview
