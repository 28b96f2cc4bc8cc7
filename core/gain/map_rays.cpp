#include "core/gain/map_rays.hpp"

#include <algorithm>

#include "core/gain/state_field.hpp"
#include "core/map/traversal.hpp"

namespace nextview {

MapRays::MapRays(const VoxelGrid& grid, VoxelBricks voxels, double occupancy_threshold, double max_range)
    : grid_(grid),
      voxels_(std::move(voxels)),
      occupancy_threshold_(occupancy_threshold),
      max_range_(max_range),
      // Less by a margin for the rounding of probabilities, which near 1 are all the same.
      surely_free_(float(std::min(log_odds(occupancy_threshold), 10.0) - 1e-3)) {}

void MapRays::cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const {
  // Room for the longest ray through the grid, so that the loop writes through a bare pointer.
  visited.resize(grid_.size.sum() + 3);
  RayVoxel* next = visited.data();
  walk_ray(grid_, origin, direction, max_range_, [&](int x, int y, int z) {
    const Voxel& voxel = voxels_.at(x, y, z);
    RayVoxel& seen = *next++;
    static_cast<Voxel&>(seen) = voxel;
    seen.has_node = voxel.measured || voxel.occlusion_distance > 0;
    seen.lattice = {static_cast<std::int16_t>(x + grid_.first.x()), static_cast<std::int16_t>(y + grid_.first.y()),
                    static_cast<std::int16_t>(z + grid_.first.z())};
    return !(voxel.measured && voxel.probability >= occupancy_threshold_);
  });
  visited.resize(next - visited.data());
}

RayEnd MapRays::end(const Vector3& origin, const Vector3& direction) const {
  const std::span<const CopyOnWrite<VoxelBricks::Brick>> bricks = voxels_.bricks();
  RayEnd end;
  walk_ray_segments(grid_, origin, direction, max_range_, [&](int x, int y, int z, double enter, double) {
    const std::size_t place = voxels_.place(x, y, z), i = place % VoxelBricks::brick_voxels;
    const VoxelBricks::Brick& brick = *bricks[place / VoxelBricks::brick_voxels];
    if (!brick.measured(i)) {
      end.crosses_unmeasured = true;
      return true;
    }
    if (brick.follows_from_log_odds() && brick.log_odds(i) < surely_free_) return true;
    if (brick[i].probability < occupancy_threshold_) return true;
    end.range = enter;
    return false;
  });
  return end;
}

std::optional<WorthOfMap> MapRays::worth_of_map(const Gain& gain, double occlusion_reach) const {
  std::optional<StateField> field = state_field(grid_, voxels_, occupancy_threshold_, gain, occlusion_reach);
  if (!field) return std::nullopt;
  return WorthOfMap{grid_, max_range_, *std::move(field)};
}

}  // namespace nextview
