#include "core/map/occupancy.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nextview {

void InverseSensorModel::validate() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(fmt::format("inverse sensor model: {}", what));
  };
  require(hit > 0.5 && hit < 1.0, "hit must lie between 0.5 and 1");
  require(miss > 0.0 && miss < 0.5, "miss must lie between 0 and 0.5");
  require(hit_decay >= -5.0 && hit_decay <= 5.0, "hit_decay must be from -5 to 5 per m");
  require(miss_decay >= -5.0 && miss_decay <= 5.0, "miss_decay must be from -5 to 5 per m");
  require(clamp_min > 0.0 && clamp_min < 0.5, "clamp_min must lie between 0 and 0.5");
  require(clamp_max > 0.5 && clamp_max < 1.0, "clamp_max must lie between 0.5 and 1");
  require(occupancy_threshold > clamp_min && occupancy_threshold < clamp_max,
          "occupancy_threshold must lie between clamp_min and clamp_max");
  require(free_below > 0.0 && free_below < occupied_above && occupied_above < 1.0,
          "free_below and occupied_above must lie between 0 and 1, in this order");
}

}  // namespace nextview
