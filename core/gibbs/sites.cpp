#include "core/gibbs/sites.hpp"

#include "core/random/counter_random.hpp"

namespace nextview {

Sites find_sites(const RayLists& lists, const PosteriorSamplerConfig& config, std::span<const float> start_map) {
  Sites sites;
  const auto voxels = static_cast<std::uint32_t>(lists.grid().voxel_count());
  sites.kind.assign(voxels, Sites::none);
  for (std::uint32_t v = 0; v < voxels; ++v) {
    if (!lists.observed(v)) continue;
    if (config.updated == UpdatedVoxels::occupied && (start_map.empty() || start_map[v] < 0.5f)) continue;
    sites.kind[v] = lists.is_near(v) ? Sites::near : Sites::front;
    (lists.is_near(v) ? sites.near_voxels : sites.front_voxels).push_back(v);
  }
  return sites;
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
