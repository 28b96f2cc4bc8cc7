#include "core/map/occupancy.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nextview {

std::vector<Setting> settings(InverseSensorModel& m) {
  return {
      {"map.hit", "", "inverse sensor model: P(occupied | a ray ended here)", &m.hit, between(0.5, 1)},
      {"map.miss", "", "inverse sensor model: P(occupied | a ray passed)", &m.miss, between(0, 0.5)},
      {"map.hit_decay", "1/m", "a hit's log-odds are those of map.hit at 1 m, times exp(-this * (range - 1 m))",
       &m.hit_decay, from_to(-5, 5)},
      {"map.miss_decay", "1/m", "a miss's log-odds likewise, those of map.miss at 1 m", &m.miss_decay, from_to(-5, 5)},
      {"map.clamp_min", "", "lowest probability", &m.clamp_min, between(0, 0.5)},
      {"map.clamp_max", "", "highest probability", &m.clamp_max, between(0.5, 1)},
      {"map.occupancy_threshold", "", "from here on a measured voxel stops a ray", &m.occupancy_threshold,
       between(0, 1)},
      {"map.free_below", "", "class free", &m.free_below, between(0, 1)},
      {"map.occupied_above", "", "class occupied", &m.occupied_above, between(0, 1)},
  };
}

void InverseSensorModel::validate() const {
  require_in_bounds(*this);
  if (!(occupancy_threshold > clamp_min && occupancy_threshold < clamp_max))
    throw std::invalid_argument(
        fmt::format("map.occupancy_threshold, {}, must lie between map.clamp_min, {}, and map.clamp_max, {}",
                    occupancy_threshold, clamp_min, clamp_max));
  if (free_below >= occupied_above)
    throw std::invalid_argument(
        fmt::format("map.free_below, {}, must be below map.occupied_above, {}", free_below, occupied_above));
}

}  // namespace nextview
