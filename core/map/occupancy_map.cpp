#include "core/map/occupancy_map.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "core/map/occlusion_marks.hpp"
#include "core/map/ray_marks.hpp"
#include "core/map/uniform_bricks.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// What a scan does to a voxel.
enum Touch : std::uint8_t { untouched = 0, passed = 1, hit = 2 };
using Touches = std::array<std::uint8_t, VoxelBricks::brick_voxels>;

bool all_same(std::span<const std::uint8_t> touches) {
  return std::memcmp(&touches[0], &touches[1], touches.size() - 1) == 0;  // each is as the one after it
}

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
  return grid.voxel_count() * (sizeof(VoxelBricks::Brick) / VoxelBricks::brick_voxels + sizeof(Touch));
}

OccupancyMap::OccupancyMap(const VoxelGrid& grid, const InverseSensorModel& model)
    : grid_(require_memory_for(grid)), model_(model), voxels_(grid.size) {
  model.validate();
}

OccupancyMap::OccupancyMap() : OccupancyMap(VoxelGrid{}) {}

VoxelClass OccupancyMap::class_of(float log_odds) const { return model_.classify(belief(log_odds).probability); }

void OccupancyMap::set_log_odds(std::uint32_t voxel, float log_odds) {
  const Eigen::Vector3i cell = grid_.cell(voxel);
  const std::size_t place = voxels_.place(cell.x(), cell.y(), cell.z());
  voxels_.change_brick_of(place).set_measured(place % VoxelBricks::brick_voxels, log_odds, class_of(log_odds));
}

void OccupancyMap::insert(const Scan& scan, const std::stop_token& stop) {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  RayMarks marks(grid_);
  marks.pass(origin, scan.hits, scan.max_range, stop);
  marks.pass(origin, scan.misses, scan.max_range, stop);
  // Hits last: a voxel where a ray ends is a hit, whatever else passes through it.
  marks.mark_ends(origin, scan.hits, scan.max_range, hit);
  add(
      [&](std::size_t brick, Touches& touches) {
        voxels_.for_each_row(brick, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
          std::memcpy(&touches[first], marks.row(cell), count);
        });
      },
      scan.origin);
}

void OccupancyMap::insert(const Scan& scan, Insertion insertion, const std::stop_token& stop) {
  if (insertion == Insertion::direct) return insert(scan, stop);
  OccupancyMap local(grid_, model_);
  local.insert(scan, stop);
  register_local(local, scan.origin);
}

/// Adds the hit or the miss, as the model has them for a camera at `origin`, to the log-odds of each touched voxel.
/// `touches_of(brick, touches)` says which are touched.
template <class TouchesOf>
void OccupancyMap::add(TouchesOf touches_of, const Vector3& origin) {
  if (model_.range_dependent()) {
    add_terms(touches_of, [&](std::size_t place, bool is_hit) {
      const double range = (grid_.centre(grid_.index(voxels_.cell(place))) - origin).norm();
      return static_cast<float>(is_hit ? model_.hit_term(range) : model_.miss_term(range));
    });
  } else {
    const auto hit_update = static_cast<float>(model_.hit_term(1.0));
    const auto miss_update = static_cast<float>(model_.miss_term(1.0));
    add_terms(touches_of, [=](std::size_t, bool is_hit) { return is_hit ? hit_update : miss_update; });
  }
}

/// Adds `term(place, is_hit)` to the log-odds of each touched voxel, and clamps.
template <class TouchesOf, class Term>
void OccupancyMap::add_terms(TouchesOf touches_of, Term term) {
  const auto lowest = static_cast<float>(nextview::log_odds(model_.clamp_min));
  const auto highest = static_cast<float>(nextview::log_odds(model_.clamp_max));
  VoxelBricks after = voxels_;  // the map stays as it was if memory runs out
  UniformBricks uniform;
  const auto bricks = after.change_bricks();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bricks.size(), 16), [&](const auto& range) {
    for (std::size_t brick = range.begin(); brick != range.end(); ++brick) {
      Touches touches{};
      touches_of(brick, touches);
      if (touches == Touches{}) continue;  // and it stays shared
      const auto log_odds_after = [&](const VoxelBricks::Brick& voxels, std::size_t i) {
        const float change = term(brick * VoxelBricks::brick_voxels + i, touches[i] == hit);
        return std::clamp(voxels.log_odds(i) + change, lowest, highest);
      };
      touch_brick(bricks[brick], touches, log_odds_after, uniform);
    }
  });
  voxels_ = std::move(after);
}

/// Gives each touched voxel `log_odds_after(brick, voxel)`. A brick that it does not change stays shared.
template <class LogOddsAfter>
void OccupancyMap::touch_brick(CopyOnWrite<VoxelBricks::Brick>& brick, std::span<const std::uint8_t> touches,
                               LogOddsAfter log_odds_after, UniformBricks& uniform) const {
  const auto changes = [&](const VoxelBricks::Brick& voxels, std::size_t i) {
    return touches[i] != untouched && (!voxels.measured(i) || log_odds_after(voxels, i) != voxels.log_odds(i));
  };
  std::size_t i = 0;
  while (i < touches.size() && !changes(*brick, i)) ++i;
  if (i == touches.size()) return;  // all at their clamps
  if (!model_.range_dependent() && brick->is_uniform() && all_same(touches)) {
    const float log_odds = log_odds_after(*brick, 0);
    brick = uniform.of(log_odds, class_of(log_odds));
    return;
  }
  VoxelBricks::Brick& voxels = brick.change();
  float last = 0.0f;  // neighbours often have the same log-odds
  VoxelClass last_class = class_of(last);
  for (; i < touches.size(); ++i) {
    if (touches[i] == untouched) continue;
    const float log_odds = log_odds_after(voxels, i);
    if (log_odds != last) last = log_odds, last_class = class_of(log_odds);
    voxels.set_measured(i, log_odds, last_class);
  }
  if (voxels.is_uniform()) brick = uniform.of(voxels.log_odds(0), voxels.voxel_class(0));
}

void OccupancyMap::register_local(const OccupancyMap& local, const Vector3& origin) {
  const bool same_grid =
      local.grid_.first == grid_.first && local.grid_.size == grid_.size && local.grid_.resolution == grid_.resolution;
  if (!same_grid || !(local.model_ == model_))
    throw std::invalid_argument(
        "occupancy map: a local map must have the grid and the model of the map it is registered into");
  // One scan's log-odds tell hits from misses; they may be clamped already, so they are not what is added.
  const auto bricks = local.voxels_.bricks();
  add(
      [&](std::size_t brick, Touches& touches) {
        const VoxelBricks::Brick& voxels = *bricks[brick];
        for (std::size_t i = 0; i < touches.size(); ++i)
          if (voxels.measured(i)) touches[i] = voxels.log_odds(i) > 0.0f ? hit : passed;
      },
      origin);
}

void OccupancyMap::mark_occlusions(const Scan& scan, double distance, const std::stop_token& stop) {
  const VoxelGrid region = region_behind(grid_, scan, distance);
  const Eigen::Vector3i in_region = grid_.first - region.first;  // from places in the grid
  OcclusionMarks marks(region);
  marks.mark(scan.origin.cast<float>(), scan.hits, scan.max_range, distance, stop);
  using Numbers = std::array<std::uint16_t, VoxelBricks::brick_voxels>;
  VoxelBricks after = voxels_;
  const auto bricks = after.change_bricks();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bricks.size(), 64), [&](const auto& range) {
    for (std::size_t brick = range.begin(); brick != range.end(); ++brick) {
      if (!region.contains(voxels_.cell(brick * VoxelBricks::brick_voxels) + in_region)) continue;
      Numbers nearest{};
      voxels_.for_each_row(brick, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
        std::memcpy(&nearest[first], marks.row(cell + in_region), count * sizeof nearest[0]);
      });
      if (nearest == Numbers{}) continue;
      const auto better = [&](const VoxelBricks::Brick& voxels, std::size_t i) {
        if (nearest[i] == 0 || voxels.measured(i)) return false;
        const std::uint16_t known = voxels.occlusion_distance(i);
        return known == 0 || nearest[i] < known;
      };
      std::size_t i = 0;
      while (i < nearest.size() && !better(*bricks[brick], i)) ++i;
      if (i == nearest.size()) continue;  // and it stays shared
      VoxelBricks::Brick& voxels = bricks[brick].change();
      for (; i < nearest.size(); ++i)
        if (better(voxels, i)) voxels.set_occlusion_distance(i, nearest[i]);
    }
  });
  voxels_ = std::move(after);
}

}  // namespace nextview
