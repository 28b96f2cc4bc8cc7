#pragma once
#include <cmath>

#include "core/calibration/update_histories.hpp"
#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview::simulated_histories {

constexpr double max_range = 1.5;  // [m]

inline VoxelGrid grid() { return region_of_interest(Vector3::Zero(), 0.6, 0.02); }

/// `count` views of a noisy sphere and rays in all directions, from 0.3 m to 1.4 m away.
inline std::vector<Scan> scans(int count, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> distance(0.3, 1.4);
  std::vector<Scan> result;
  for (int n = 0; n < count; ++n) {
    const Vector3 origin = distance(random) * random_scans::direction(random);
    result.push_back(random_scans::scan(random, origin, grid().resolution, 1500, max_range));
    random_scans::add_passes(result.back(), random, 100);
  }
  return result;
}

inline OccupancyMap map(const std::vector<Scan>& scans, const InverseSensorModel& model) {
  OccupancyMap result(grid(), model);
  for (const Scan& scan : scans) result.insert(scan);
  return result;
}

inline std::vector<float> probabilities(const OccupancyMap& map) { return nextview::probabilities(map.voxels()); }

inline std::vector<std::uint8_t> everywhere() { return std::vector<std::uint8_t>(grid().voxel_count(), 1); }

/// Of all voxels, their targets what the map of the same scans holds with `model`.
inline UpdateHistories histories(const std::vector<Scan>& scans, const InverseSensorModel& model) {
  UpdateHistories result;
  result.add(grid(), scans, probabilities(map(scans, model)), everywhere());
  return result;
}

inline InverseSensorModel model(double hit, double miss, double clamp_min, double clamp_max, double hit_decay = 0.0,
                                double miss_decay = 0.0) {
  InverseSensorModel result;
  result.hit = hit, result.miss = miss;
  result.clamp_min = clamp_min, result.clamp_max = clamp_max;
  result.hit_decay = hit_decay, result.miss_decay = miss_decay;
  return result;
}

}  // namespace nextview::simulated_histories
