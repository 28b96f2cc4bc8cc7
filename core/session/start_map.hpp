#pragma once
#include <filesystem>
#include <memory>

#include "core/config/configuration.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// The octree that a scan begins with (map.start). A resolution that was not given is the file's.
/// @throws std::runtime_error naming the file; std::invalid_argument if another resolution was given
std::shared_ptr<const OccupancyMap> read_start_map(Configuration& configuration);

/// The configuration with the map's box for its region of interest, and the lengths that suit it.
Configuration framed_by(const OccupancyMap& map, Configuration configuration);

/// Takes over what a map of the same resolution has measured, where the regions overlap.
void begin_with(const OccupancyMap& start, OccupancyMap& map);

}  // namespace nextview
