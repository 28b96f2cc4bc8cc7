#pragma once
#include <octomap/OcTree.h>

#include "core/map/occupancy_map.hpp"

namespace nextview::octomap_twin {

inline octomap::point3d to_octomap(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

inline octomap::OcTree tree(double resolution, const InverseSensorModel& model) {
  octomap::OcTree tree(resolution);
  tree.setProbHit(model.hit);
  tree.setProbMiss(model.miss);
  tree.setClampingThresMin(model.clamp_min);
  tree.setClampingThresMax(model.clamp_max);
  tree.setOccupancyThres(model.occupancy_threshold);
  return tree;
}

/// OctoMap's insertPointCloud; with passes the same in two steps, since it has no word for a ray that ends nowhere.
inline void insert(octomap::OcTree& tree, const Scan& scan) {
  const octomap::point3d origin = to_octomap(scan.origin.cast<float>());
  octomap::Pointcloud cloud;
  for (const auto& p : scan.hits) cloud.push_back(to_octomap(p));
  if (scan.misses.empty()) return tree.insertPointCloud(cloud, origin, scan.max_range);

  octomap::KeySet free, occupied;
  tree.computeUpdate(cloud, origin, free, occupied, scan.max_range);
  octomap::KeyRay ray;
  for (const auto& p : scan.misses) {
    tree.computeRayKeys(origin, to_octomap(p), ray);
    for (const auto& key : ray)
      if (!occupied.count(key)) free.insert(key);
  }
  for (const auto& key : free) tree.updateNode(key, false);
  for (const auto& key : occupied) tree.updateNode(key, true);
}

/// The node that holds a voxel of the grid; null if the tree has none there.
inline const octomap::OcTreeNode* node(const octomap::OcTree& tree, const VoxelGrid& grid, std::uint32_t voxel) {
  const Eigen::Vector3i lattice = grid.first + grid.cell(voxel);
  const int origin = 1 << (tree.getTreeDepth() - 1);
  const octomap::OcTreeKey key(lattice.x() + origin, lattice.y() + origin, lattice.z() + origin);
  return tree.search(key);
}

struct Differences {
  std::size_t measured = 0;   ///< voxels that the tree knows
  std::size_t different = 0;  ///< known to one only, or not the same float
};

inline Differences compare(const OccupancyMap& map, const octomap::OcTree& tree) {
  Differences d;
  for (std::uint32_t i = 0; i < map.grid().voxel_count(); ++i) {
    const auto* leaf = node(tree, map.grid(), i);
    d.measured += leaf != nullptr;
    d.different += bool(leaf) != map.voxels()[i].measured || (leaf ? leaf->getLogOdds() : 0.0f) != map.log_odds(i);
  }
  return d;
}

}  // namespace nextview::octomap_twin
