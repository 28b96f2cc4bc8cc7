#pragma once
#include <bit>
#include <map>
#include <mutex>
#include <utility>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// Bricks of measured voxels that are all the same, one of each for all places that have such: so free space, which has
/// few different log-odds, takes next to no memory. May be asked from several threads.
class UniformBricks {
 public:
  CopyOnWrite<VoxelBricks::Brick> of(float log_odds, VoxelClass voxel_class) {
    const std::scoped_lock lock(mutex_);
    const auto [known, is_new] = bricks_.try_emplace({std::bit_cast<std::uint32_t>(log_odds), voxel_class});
    if (is_new)
      for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i)
        known->second.change().set_measured(i, log_odds, voxel_class);
    return known->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<std::uint32_t, VoxelClass>, CopyOnWrite<VoxelBricks::Brick>> bricks_;
};

}  // namespace nextview
