#include "core/map/occupancy_map.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "core/map/ray_marks.hpp"
#include "core/map/traversal.hpp"
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

/// How far each place of a map's bricks lies behind a surface, 0 where it does not. It is of one scan: a copy of the
/// map has none. Only where something is said it takes memory: the system gives the rest no pages.
class Distances {
 public:
  explicit Distances(std::size_t bricks)
      : places_(static_cast<std::uint16_t*>(std::calloc(bricks * volume, sizeof(std::uint16_t))), &std::free),
        is_marked_(bricks) {
    if (!places_ && bricks > 0) throw std::bad_alloc();
  }

  /// The smallest of several says how far it is. From several threads.
  void mark(std::size_t place, std::uint16_t distance) {
    std::atomic_ref<std::uint16_t> nearest(places_.get()[place]);
    std::uint16_t seen = nearest.load(std::memory_order_relaxed);
    while ((seen == 0 || distance < seen) &&
           !nearest.compare_exchange_weak(seen, distance, std::memory_order_relaxed)) {
    }
    std::atomic_ref(is_marked_[place / volume]).store(1, std::memory_order_relaxed);
  }

  /// Calls `visit(brick, its distances)` for the bricks where any is not 0, several at once.
  template <class Visit>
  void for_each_brick(Visit visit) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, is_marked_.size(), 256), [&](const auto& range) {
      for (std::size_t brick = range.begin(); brick != range.end(); ++brick)
        if (is_marked_[brick]) visit(brick, &places_.get()[brick * volume]);
    });
  }

 private:
  static constexpr std::size_t volume = VoxelBricks::brick_voxels;
  std::unique_ptr<std::uint16_t, decltype(&std::free)> places_;
  std::vector<std::uint8_t> is_marked_;
};

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
  for (const auto& point : scan.hits) {
    const Eigen::Vector3i cell = grid_.cell_at(point.cast<double>());
    if (grid_.contains(cell) && ray_length(origin, point) <= scan.max_range) marks.set(cell, hit);
  }
  add(
      [&](std::size_t brick, Touches& touches) {
        const Eigen::Vector3i first = voxels_.cell(brick * VoxelBricks::brick_voxels);
        const Eigen::Vector3i size = (grid_.size - first).cwiseMin(VoxelBricks::edge);
        for (int z = 0; z < size.z(); ++z)
          for (int y = 0; y < size.y(); ++y)
            std::memcpy(&touches[std::size_t(z * VoxelBricks::edge + y) * VoxelBricks::edge],
                        marks.row(first.x(), first.y() + y, first.z() + z), std::size_t(size.x()));
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
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  Distances nearest_behind(voxels_.brick_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan.hits.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3f& point = scan.hits[i];
      const double length = ray_length(origin, point);
      if (length > scan.max_range || length == 0.0 || !grid_.contains(grid_.cell_at(point.cast<double>()))) continue;
      const Eigen::Vector3f end = point_on_ray(origin, point, length + distance);
      int behind = -1;  // the return's own voxel is no. 0
      walk_segment(grid_, point, end, [&](int x, int y, int z) {
        if (!grid_.contains({x, y, z}) || ++behind > 65535) return false;
        if (behind == 0) return true;
        nearest_behind.mark(voxels_.place(x, y, z), static_cast<std::uint16_t>(behind));
        return true;
      });
    }
  });
  throw_if_stopped(stop);
  VoxelBricks after = voxels_;
  const auto bricks = after.change_bricks();
  nearest_behind.for_each_brick([&](std::size_t brick, const std::uint16_t* nearest) {
    const auto better = [&](const VoxelBricks::Brick& voxels, std::size_t i) {
      if (nearest[i] == 0 || voxels.measured(i)) return false;
      const std::uint16_t known = voxels.occlusion_distance(i);
      return known == 0 || nearest[i] < known;
    };
    std::size_t i = 0;
    while (i < VoxelBricks::brick_voxels && !better(*bricks[brick], i)) ++i;
    if (i == VoxelBricks::brick_voxels) return;  // and it stays shared
    VoxelBricks::Brick& voxels = bricks[brick].change();
    for (; i < VoxelBricks::brick_voxels; ++i)
      if (better(voxels, i)) voxels.set_occlusion_distance(i, nearest[i]);
  });
  voxels_ = std::move(after);
}

}  // namespace nextview
