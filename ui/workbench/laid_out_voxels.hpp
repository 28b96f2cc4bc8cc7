#pragma once
#include <memory>
#include <vector>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// The voxels of a map in the grid's order, laid out when they are first looked at, by whichever thread does: going
/// back a view takes less time than that. Copies share them. Like a pointer, it may be null.
class LaidOutVoxels {
 public:
  LaidOutVoxels() = default;
  explicit LaidOutVoxels(VoxelBricks bricks);
  explicit LaidOutVoxels(std::vector<Voxel> voxels);
  const std::vector<Voxel>& operator*() const;                      ///< @pre it is not null
  const std::vector<Voxel>* operator->() const { return &**this; }  ///< likewise
  /// As a map keeps them. @pre it is not null, and they are of `size`
  VoxelBricks bricks(const Eigen::Vector3i& size) const;
  explicit operator bool() const { return shared_ != nullptr; }

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace nextview
