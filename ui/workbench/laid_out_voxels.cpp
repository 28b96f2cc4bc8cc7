#include "ui/workbench/laid_out_voxels.hpp"

#include <tbb/task_arena.h>

#include <mutex>
#include <utility>

namespace nextview {

struct LaidOutVoxels::Shared {
  std::once_flag once = {};
  VoxelBricks bricks;  ///< that they are laid out from; none if they came as they are
  std::vector<Voxel> voxels;
};

LaidOutVoxels::LaidOutVoxels(VoxelBricks bricks) : shared_(std::make_shared<Shared>()) {
  shared_->bricks = std::move(bricks);
}

LaidOutVoxels::LaidOutVoxels(std::vector<Voxel> voxels) : shared_(std::make_shared<Shared>()) {
  std::call_once(shared_->once, [&] { shared_->voxels = std::move(voxels); });
}

VoxelBricks LaidOutVoxels::bricks(const Eigen::Vector3i& size) const {
  return shared_->bricks.size() > 0 ? shared_->bricks : VoxelBricks(size, shared_->voxels);
}

const std::vector<Voxel>& LaidOutVoxels::operator*() const {
  std::call_once(shared_->once, [this] {
    // Isolated: while it waits, this thread must not take up work that looks at the same.
    tbb::this_task_arena::isolate([this] { shared_->voxels = shared_->bricks.dense(); });
  });
  return shared_->voxels;
}

}  // namespace nextview
