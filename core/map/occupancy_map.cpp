#include "core/map/occupancy_map.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <stdexcept>

#include "core/map/traversal.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

enum Touch : std::uint8_t { untouched = 0, passed = 1, hit = 2 };

/// Before any of it is taken: memory that is promised and not there ends the program without a word.
const VoxelGrid& require_memory_for(const VoxelGrid& grid) {
  constexpr std::uint64_t small = std::uint64_t{16} << 20;  // asking takes as long as making such a map
  if (OccupancyMap::bytes(grid) > small)
    require_memory(OccupancyMap::bytes(grid),
                   fmt::format("a map of {} x {} x {} voxels", grid.size.x(), grid.size.y(), grid.size.z()),
                   "use coarser voxels or a smaller region");
  return grid;
}

}  // namespace

std::uint64_t OccupancyMap::bytes(const VoxelGrid& grid) {
  return grid.voxel_count() * (sizeof(float) + sizeof(Voxel) + sizeof(std::uint8_t));
}

OccupancyMap::OccupancyMap(const VoxelGrid& grid, const InverseSensorModel& model)
    : grid_(require_memory_for(grid)),
      model_(model),
      log_odds_(grid.voxel_count()),
      voxels_(grid.voxel_count()),
      touched_(grid.voxel_count()) {
  model.validate();
}

/// A measured voxel with these log-odds.
Voxel OccupancyMap::measured_voxel(float log_odds) const {
  const double p = probability(log_odds);
  return {static_cast<float>(p), static_cast<float>(entropy(p)), model_.classify(p), true};
}

void OccupancyMap::set_log_odds(std::uint32_t voxel, float log_odds) {
  log_odds_[voxel] = log_odds;
  voxels_[voxel] = measured_voxel(log_odds);
}

void OccupancyMap::insert(const Scan& scan, double max_range, const std::stop_token& stop, MapChanges* undo) try {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  // Hits first: a voxel where a ray ends is a hit, whatever else passes through it.
  for (const auto& point : scan.returns) {
    const Eigen::Vector3i cell = grid_.cell_at(point.cast<double>());
    if (grid_.contains(cell) && ray_length(origin, point) <= max_range) touched_[grid_.index(cell)] = hit;
  }
  // Rays side by side: they only ever turn `untouched` into `passed`, so their order does not matter.
  const auto pass = [&](const PointCloud& ends) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ends.size(), 1024), [&](const auto& range) {
      if (stop.stop_requested()) return;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const bool short_enough = ray_length(origin, ends[i]) <= max_range;
        const Eigen::Vector3f end = short_enough ? ends[i] : point_on_ray(origin, ends[i], max_range);
        walk_segment_inside(grid_, origin, end, [&](int x, int y, int z) {
          std::atomic_ref<std::uint8_t> touch(touched_[grid_.index({x, y, z})]);
          if (touch.load(std::memory_order_relaxed) == untouched) touch.store(passed, std::memory_order_relaxed);
          return true;
        });
      }
    });
  };
  pass(scan.returns);
  pass(scan.passes);
  throw_if_stopped(stop);
  if (undo) remember_touched(*undo);
  update_touched(scan.origin);
} catch (...) {
  std::ranges::fill(touched_, untouched);
  throw;
}

void OccupancyMap::remember_touched(MapChanges& undo) const {
  for (std::uint32_t v = 0; v < touched_.size(); ++v)
    if (touched_[v] != untouched) undo.changes.push_back({v, log_odds_[v], voxels_[v]});
}

/// Adds the hit or the miss, as the model has them for a camera at `origin`, to the log-odds of each touched voxel.
void OccupancyMap::update_touched(const Vector3& origin) {
  if (model_.range_dependent()) {
    add_to_touched([&](std::uint32_t voxel, bool is_hit) {
      const double range = (grid_.centre(voxel) - origin).norm();
      return static_cast<float>(is_hit ? model_.hit_term(range) : model_.miss_term(range));
    });
  } else {
    const auto hit_update = static_cast<float>(model_.hit_term(1.0));
    const auto miss_update = static_cast<float>(model_.miss_term(1.0));
    add_to_touched([=](std::uint32_t, bool is_hit) { return is_hit ? hit_update : miss_update; });
  }
}

/// Adds `term(voxel, is_hit)` to the log-odds of each touched voxel, clamps, and clears the scratch.
template <class Term>
void OccupancyMap::add_to_touched(Term term) {
  const auto lowest = static_cast<float>(nextview::log_odds(model_.clamp_min));
  const auto highest = static_cast<float>(nextview::log_odds(model_.clamp_max));
  constexpr std::size_t chunk = 8;  // eight touches are looked at as one word: most voxels are untouched
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (touched_.size() + chunk - 1) / chunk, 4096),
                    [&](const auto& range) {
                      float last_log_odds = 0.0f;  // neighbours often have the same, and logarithms are dear
                      Voxel last_voxel = measured_voxel(last_log_odds);
                      for (std::size_t c = range.begin(); c != range.end(); ++c) {
                        const std::size_t first = c * chunk, last = std::min(first + chunk, touched_.size());
                        if (last - first == chunk) {
                          std::uint64_t word;
                          std::memcpy(&word, &touched_[first], chunk);
                          if (word == 0) continue;
                        }
                        for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) {
                          if (touched_[v] == untouched) continue;
                          log_odds_[v] = std::clamp(log_odds_[v] + term(v, touched_[v] == hit), lowest, highest);
                          if (log_odds_[v] != last_log_odds) last_voxel = measured_voxel(last_log_odds = log_odds_[v]);
                          voxels_[v] = last_voxel;
                          touched_[v] = untouched;
                        }
                      }
                    });
}

void OccupancyMap::register_local(const OccupancyMap& local, const Vector3& origin, MapChanges* undo) try {
  const bool same_grid =
      local.grid_.first == grid_.first && local.grid_.size == grid_.size && local.grid_.resolution == grid_.resolution;
  if (!same_grid || !(local.model_ == model_))
    throw std::invalid_argument(
        "occupancy map: a local map must have the grid and the model of the map it is registered into");
  // One scan's log-odds tell hits from passes; they may be clamped already, so they are not what is added.
  for (std::size_t v = 0; v < voxels_.size(); ++v)
    touched_[v] = !local.voxels_[v].measured ? untouched : local.log_odds_[v] > 0.0f ? hit : passed;
  if (undo) remember_touched(*undo);
  update_touched(origin);
} catch (...) {
  std::ranges::fill(touched_, untouched);
  throw;
}

void OccupancyMap::mark_occlusions(const Scan& scan, double max_range, double reach, const std::stop_token& stop,
                                   MapChanges* undo) {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  tbb::combinable<std::vector<MapChanges::Change>> changes;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan.returns.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    auto& own_changes = changes.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3f& point = scan.returns[i];
      const double length = ray_length(origin, point);
      if (length > max_range || length == 0.0 || !grid_.contains(grid_.cell_at(point.cast<double>()))) continue;
      const Eigen::Vector3f end = point_on_ray(origin, point, length + reach);
      int behind = -1;  // the return's own voxel is no. 0
      walk_segment(grid_, point, end, [&](int x, int y, int z) {
        if (!grid_.contains({x, y, z}) || ++behind > 65535) return false;
        Voxel& voxel = voxels_[grid_.index({x, y, z})];
        if (behind == 0 || voxel.measured) return true;
        std::atomic_ref<std::uint16_t> nearest(voxel.occlusion_distance);
        std::uint16_t seen = nearest.load(std::memory_order_relaxed);
        while (seen == 0 || behind < seen) {
          if (!nearest.compare_exchange_weak(seen, static_cast<std::uint16_t>(behind), std::memory_order_relaxed))
            continue;
          if (undo) own_changes.push_back({grid_.index({x, y, z}), 0.0f, Voxel{.occlusion_distance = seen}});
          break;
        }
        return true;
      });
    }
  });
  if (undo)
    changes.combine_each(
        [&](const auto& some) { undo->changes.insert(undo->changes.end(), some.begin(), some.end()); });
  throw_if_stopped(stop);
}

void OccupancyMap::go_back(const MapChanges& undo) {
  const auto weaker = [](std::uint16_t a, std::uint16_t b) { return b != 0 && (a == 0 || a > b); };
  for (const auto& [voxel, log_odds, before] : undo.changes) {
    Voxel& now = voxels_[voxel];
    // A mark can have been bettered several times, by several threads: the weakest is the first.
    if (!now.measured && !weaker(before.occlusion_distance, now.occlusion_distance)) continue;
    log_odds_[voxel] = log_odds;
    now = before;
  }
}

}  // namespace nextview
