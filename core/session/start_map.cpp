#include "core/session/start_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/config/object_lengths.hpp"
#include "core/map/octree_file.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {

std::shared_ptr<const OccupancyMap> read_start_map(Configuration& c) {
  auto map = std::make_shared<const OccupancyMap>(read_octree(c.map.start, c.map.model));
  const double resolution = map->grid().resolution;
  set_unless_given(c, "map.resolution", fmt::format("{}", resolution));
  if (std::abs(c.map.resolution / resolution - 1.0) > 1e-6)
    throw std::invalid_argument(
        c.as_given(fmt::format("map.resolution, {}, must be that of the map to begin with, {} ({})",
                               length_text(c.map.resolution), length_text(resolution), c.map.start)));
  return map;
}

Configuration framed_by(const OccupancyMap& map, Configuration c) {
  const Vector3 low = map.grid().lower(), high = map.grid().upper();
  fit_lengths(c, (high - low).maxCoeff());
  c.map.region = fmt::format("{} {} {} {} {} {}", low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  c.fitted["map.region"] = c.map.region;  // what is opened next has its own
  return c;
}

void begin_with(const OccupancyMap& start, OccupancyMap& map) {
  const Eigen::Vector3i shift = start.grid().first - map.grid().first;
  std::uint32_t v = 0;
  for (const Voxel& voxel : start.voxels()) {
    const Eigen::Vector3i cell = start.grid().cell(v++) + shift;
    if (voxel.measured && map.grid().contains(cell)) map.set_log_odds(map.grid().index(cell), voxel.log_odds);
  }
}

}  // namespace nextview
