#include "core/gibbs/sites.hpp"

#include <utility>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

/// Calls `visit(voxel)` for all voxels of a grid, brick after brick: the rays through one are few, and stay at hand.
template <class Visit>
void for_each_in_bricks(const VoxelGrid& grid, Visit visit) {
  constexpr int edge = 8;
  const Eigen::Vector3i end = grid.size;
  const auto voxels = [&](const Eigen::Vector3i& first) {
    const Eigen::Vector3i last = (first.array() + edge).min(end.array());
    for (int z = first.z(); z < last.z(); ++z)
      for (int y = first.y(); y < last.y(); ++y)
        for (int x = first.x(); x < last.x(); ++x) visit(static_cast<std::uint32_t>(grid.index({x, y, z})));
  };
  for (int z = 0; z < end.z(); z += edge)
    for (int y = 0; y < end.y(); y += edge)
      for (int x = 0; x < end.x(); x += edge) voxels({x, y, z});
}

}  // namespace

Sites find_sites(const RayLists& lists, const PosteriorSamplerConfig& config, std::span<const float> start_map,
                 std::uint32_t first_ray) {
  Sites sites;
  sites.kind.assign(lists.grid().voxel_count(), Sites::none);
  for_each_in_bricks(lists.grid(), [&](std::uint32_t v) {
    if (!lists.observed(v)) return;
    if (config.updated == UpdatedVoxels::occupied && (start_map.empty() || start_map[v] < 0.5f)) return;
    if (!lists.is_near(v) && lists.front(v).back().ray() < first_ray) return;  // the last is the latest
    sites.kind[v] = lists.is_near(v) ? Sites::near : Sites::front;
    (lists.is_near(v) ? sites.near_voxels : sites.front_voxels).push_back(v);
  });
  return sites;
}

BitRows voxels_read_out(const VoxelGrid& grid, const Sites& sites) {
  BitRows around(grid.size);
  for (const std::uint32_t v : sites.near_voxels) around.set(grid.cell(v));
  around = with_neighbours(with_neighbours(std::move(around)));
  for (const std::uint32_t v : sites.front_voxels) around.set(grid.cell(v));
  return around;
}

BitRows with_neighbours(BitRows voxels) {
  voxels.grow({});
  return voxels;
}

std::vector<std::uint8_t> start_levels(const RayLists& lists, const PosteriorSamplerConfig& config,
                                       std::span<const float> start_map, int chain) {
  const auto upper = static_cast<std::uint8_t>(config.model.levels() - 1);
  std::vector<std::uint8_t> levels(lists.grid().voxel_count(), 0);
  const CounterRandom random(config.seed, random_stream::gibbs + static_cast<std::uint32_t>(chain) * 64 + 63);
  for (std::uint32_t v = 0; v < levels.size(); ++v) {
    if (!lists.observed(v)) continue;
    const bool occupied = config.start == StartMap::occupied ||
                          (config.start == StartMap::octree && !start_map.empty() && start_map[v] >= 0.5f);
    if (occupied) levels[v] = upper;
    if (config.start == StartMap::random)
      levels[v] = static_cast<std::uint8_t>(random.uniform(v)[0] * config.model.levels());
  }
  return levels;
}

}  // namespace nextview
