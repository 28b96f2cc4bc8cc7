#include "core/gibbs/ray_lists.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/gibbs/optical_depth.hpp"
#include "core/map/traversal.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr double longest_chord = std::numbers::sqrt3;
constexpr std::size_t max_rays = std::size_t{1} << 22;  // what FrontEntry can number
constexpr std::size_t max_voxels = std::size_t{1} << 27;
constexpr std::size_t max_bytes = std::size_t{8} << 30;
constexpr std::size_t incidence_bytes = sizeof(RayLists::Incidence) + sizeof(RayLists::NearEntry);

std::uint32_t chord_code(double chord) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): none is negative, and lround() takes longer
  return std::min(static_cast<std::uint32_t>(chord * ((RayLists::chord_codes - 1) / longest_chord) + 0.5),
                  RayLists::chord_codes - 1);
}

}  // namespace

/// A part of the rays, counted and filled in by one thread. Entries come out by ray,
/// whatever the parts.
struct RayLists::Block {
  std::uint32_t first_ray = 0, last_ray = 0;
  std::vector<std::uint32_t> front, near;  ///< per voxel: how many entries; later: where the next one goes
};

void RayLists::require_holdable(const VoxelGrid& grid) {
  if (grid.voxel_count() > max_voxels)
    throw std::invalid_argument(fmt::format("gibbs: {} voxels are more than the {} it can hold; use a coarser map",
                                            grid.voxel_count(), max_voxels));
  // A ray crosses no more voxels than that.
  const auto sides = grid.size.cast<std::int64_t>().sum();
  if (sides > optical_depth::most_voxels)
    throw std::invalid_argument(
        fmt::format("gibbs: a region of {} voxels along its three sides together is longer than "
                    "the {} it can hold; use a coarser map",
                    sides, optical_depth::most_voxels));
}

double RayLists::chord(std::uint32_t code) { return code * longest_chord / (chord_codes - 1); }

RayLists::RayLists(const VoxelGrid& grid, const RangeMeasurements& measurements, const ForwardSensorModel& model,
                   const std::stop_token& stop)
    : grid_(grid), measurements_{measurements.max_range, {}, {}}, model_(model) {
  model_.validate();
  require_holdable(grid_);
  incidences_begin_.assign(1, 0);
  front_.begin = near_.begin = std::vector<std::uint32_t>(grid_.voxel_count() + 1);
  append(measurements, stop);
}

void RayLists::append(const RangeMeasurements& measurements, const std::stop_token& stop) {
  const std::size_t first = take_rays(measurements), added = rays() - first;
  incidences_begin_.resize(rays() + 1);
  constexpr std::size_t many = 100'000;  // fewer are counted before more threads have cleared their counts
  std::vector<Block> blocks(grid_.voxel_count() > (1u << 24) ? 1 : added < many ? 2 : 4);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    blocks[b].first_ray = static_cast<std::uint32_t>(first + added * b / blocks.size());
    blocks[b].last_ray = static_cast<std::uint32_t>(first + added * (b + 1) / blocks.size());
  }
  tbb::parallel_for_each(blocks, [&](Block& block) { count(block, stop); });
  for (std::size_t ray = first; ray < rays(); ++ray) incidences_begin_[ray + 1] += incidences_begin_[ray];
  lay_out(blocks);
  tbb::parallel_for_each(blocks, [&](Block& block) { fill(block, stop); });
}

std::size_t RayLists::bytes() const {
  return front_.size() * sizeof(FrontEntry) + near_.size() * incidence_bytes +
         rays() * (sizeof(RangeMeasurement) + 4 + 4 + 4) + grid_.voxel_count() * 8;
}

/// Returns how many there were.
std::size_t RayLists::take_rays(const RangeMeasurements& measurements) {
  const std::size_t before = rays();
  for (auto* of_rays : {&weight_, &incidences_begin_}) of_rays->reserve(before + measurements.rays.size() + 1);
  open_value_.reserve(before + measurements.rays.size());
  measurements_.append(measurements);
  auto& rays = measurements_.rays;
  const auto stays_outside = [&](const RangeMeasurement& ray) {
    bool enters = false;
    walk_ray(grid_, measurements_.origins[ray.origin], measurements_.direction(ray),
             list_end(measurements_, ray, model_), [&](int, int, int) { return !(enters = true); });
    return !enters;
  };
  rays.erase(std::remove_if(rays.begin() + std::ptrdiff_t(before), rays.end(), stays_outside), rays.end());
  if (rays.size() > max_rays)
    throw std::invalid_argument(
        fmt::format("gibbs: {} rays are more than the {} it can hold; merge them with a larger gibbs.ray_spacing",
                    rays.size(), max_rays));
  for (const RangeMeasurement& ray : std::span(rays).subspan(before)) {
    weight_.push_back(ray.weight);
    open_value_.push_back(open_value_of(ray));
  }
  return before;
}

/// Calls on_front(voxel, chord code) and on_near(segment) along a ray.
template <class Front, class Near>
void RayLists::walk(std::uint32_t ray, Front on_front, Near on_near) const {
  const RangeMeasurement& m = measurements_.rays[ray];
  const double z = measurements_.range(m);
  const double end = list_end(measurements_, m, model_);
  // A voxel's centre may be half a diagonal nearer or farther than where the ray leaves the voxel.
  const double slack = model_.voxel_range == VoxelRange::centre ? 0.5 * longest_chord * grid_.resolution : 0.0;
  const double near = model_.is_first_hit() ? 0.0 : m.beyond_range ? 2.0 * z : z - 4.0 * model_.sigma - slack;
  const double per_edge = 1.0 / grid_.resolution;
  walk_ray_segments(grid_, measurements_.origins[m.origin], measurements_.direction(m), end,
                    [&](int x, int y, int z_cell, double enter, double exit) {
                      if (m.beyond_range) exit = std::min(exit, end);
                      const std::uint32_t voxel = grid_.index({x, y, z_cell});
                      if (exit < near)
                        on_front(voxel, chord_code((exit - enter) * per_edge));
                      else
                        on_near(VoxelSegment{voxel, enter, exit});
                      return true;
                    });
}

void RayLists::count(Block& block, const std::stop_token& stop) {
  block.front.assign(grid_.voxel_count(), 0);
  block.near.assign(grid_.voxel_count(), 0);
  for (std::uint32_t ray = block.first_ray; ray < block.last_ray; ++ray) {
    throw_if_stopped(stop);
    std::uint32_t incidences = 0;
    walk(
        ray, [&](std::uint32_t voxel, std::uint32_t) { ++block.front[voxel]; },
        [&](const VoxelSegment& segment) {
          ++block.near[segment.voxel];
          ++incidences;
        });
    incidences_begin_[ray + 1] = incidences;
  }
}

/// Where the entries of a voxel begin, and how many there are in all.
struct RayLists::Places {
  std::vector<std::uint32_t> begin;
  std::size_t total = 0;
};

/// Leaves room behind what each voxel has for what the blocks counted, and tells them where theirs goes.
template <class Entry>
RayLists::Places RayLists::place(const ByVoxel<Entry>& lists, std::vector<Block>& blocks,
                                 std::vector<std::uint32_t> Block::*counts) {
  const std::size_t voxels = lists.begin.size() - 1;
  Places places{std::vector<std::uint32_t>(voxels + 1)};
  for (std::uint32_t v = 0; v < voxels; ++v) {
    places.begin[v] = static_cast<std::uint32_t>(places.total);
    places.total += lists.of(v).size();
    for (Block& block : blocks) {
      std::uint32_t& count = (block.*counts)[v];
      places.total += std::exchange(count, static_cast<std::uint32_t>(places.total));
    }
  }
  places.begin[voxels] = static_cast<std::uint32_t>(places.total);
  return places;
}

void RayLists::require_memory_for(std::size_t front, std::size_t near) const {
  const std::size_t bytes = front * sizeof(FrontEntry) + near * incidence_bytes;
  constexpr const char* advice = "merge rays with a larger gibbs.ray_spacing, or use a coarser map";
  if (bytes > max_bytes || std::max(front, near) >= 0xffffffffu)
    throw std::invalid_argument(
        fmt::format("gibbs: the lists of {} rays would take {:.1f} GiB, more than the {} GiB allowed; {}", rays(),
                    static_cast<double>(bytes) / (1 << 30), max_bytes >> 30, advice));
  require_memory(bytes, fmt::format("gibbs: the lists of {} rays", rays()), advice);
}

void RayLists::lay_out(std::vector<Block>& blocks) {
  Places front = place(front_, blocks, &Block::front), near = place(near_, blocks, &Block::near);
  require_memory_for(front.total, near.total);
  const auto move_to = [](auto& lists, Places& places, std::size_t beyond) {
    decltype(lists.entries) moved(places.total + beyond);
    std::fill_n(moved.end() - std::ptrdiff_t(beyond), beyond, typename decltype(moved)::value_type{});
    if (lists.size() > 0)
      tbb::parallel_for(std::size_t{0}, places.begin.size() - 1, [&](std::size_t v) {
        std::ranges::copy(lists.of(static_cast<std::uint32_t>(v)), moved.begin() + places.begin[v]);
      });
    lists = {std::move(places.begin), std::move(moved)};
  };
  move_to(front_, front, entries_beyond);
  move_to(near_, near, 0);
  incidences_.reserve(near.total);  // no more than that
  incidences_.resize(near.total);
}

void RayLists::fill(Block& block, const std::stop_token& stop) {
  for (std::uint32_t ray = block.first_ray; ray < block.last_ray; ++ray) {
    throw_if_stopped(stop);
    std::uint32_t incidence = incidences_begin_[ray];
    walk(
        ray,
        [&](std::uint32_t voxel, std::uint32_t code) {
          front_.entries[block.front[voxel]++] = FrontEntry{ray << 10 | code};
        },
        [&](const VoxelSegment& segment) {
          near_.entries[block.near[segment.voxel]++] = {ray, incidence};
          const std::uint32_t chord = chord_code((segment.exit - segment.enter) / grid_.resolution);
          incidences_[incidence] = {segment.voxel, static_cast<std::uint16_t>(chord),
                                    place_of(measurements_.rays[ray], segment),
                                    incidence_value_of(measurements_.rays[ray], segment)};
          ++incidence;
        });
  }
}

std::uint32_t RayLists::first_ray_of(std::uint32_t origin) const {
  const auto& rays = measurements_.rays;
  return static_cast<std::uint32_t>(std::ranges::lower_bound(rays, origin, {}, &RangeMeasurement::origin) -
                                    rays.begin());
}

RayLists::RangeFrom RayLists::range_from(std::uint32_t voxel, std::uint32_t ray) const {
  const RangeMeasurement& measured = measurements_.rays[ray];
  const Vector3 direction = measurements_.direction(measured);
  const Vector3 centre = grid_.centre(voxel) - measurements_.origins[measured.origin];
  const double z = measurements_.range(measured);
  double enter = 0.0, exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double middle = centre[axis] / direction[axis];
    const double half = 0.5 * grid_.resolution / std::abs(direction[axis]);
    enter = std::max(enter, middle - half), exit = std::min(exit, middle + half);
  }
  return {static_cast<float>((z - centre.dot(direction)) / grid_.resolution),
          static_cast<float>(std::max({0.0, enter - z, z - exit}) / grid_.resolution)};
}

RayLists::Place RayLists::place_of(const RangeMeasurement& ray, const VoxelSegment& segment) const {
  const double z = measurements_.range(ray);
  if (ray.beyond_range || segment.exit <= z) return Place::in_front;
  return segment.enter <= z ? Place::at_range : Place::behind;
}

float RayLists::open_value_of(const RangeMeasurement& ray) const {
  if (model_.is_first_hit())
    return static_cast<float>(first_hit_log_likelihood(grid_, model_, measurements_.origins[ray.origin],
                                                       measurements_.direction(ray), nullptr, measurements_.range(ray),
                                                       measurements_.max_range));
  if (!ray.beyond_range) return 0.0f;
  return static_cast<float>((1.0 - model_.random_weight - model_.max_weight) / model_.max_weight);
}

float RayLists::incidence_value_of(const RangeMeasurement& ray, const VoxelSegment& segment) const {
  const Vector3& origin = measurements_.origins[ray.origin];
  const double z = measurements_.range(ray);
  if (model_.is_first_hit())
    return static_cast<float>(first_hit_log_likelihood(grid_, model_, origin, measurements_.direction(ray), &segment, z,
                                                       measurements_.max_range));
  const double random_density = model_.random_weight / measurements_.max_range;
  return static_cast<float>(model_.hit_weight() * hit_density(grid_, model_, origin, segment, z) / random_density);
}

void RayLists::cast_front(std::uint32_t ray, std::vector<FrontVoxel>& voxels) const {
  voxels.clear();
  walk(
      ray,
      [&](std::uint32_t voxel, std::uint32_t code) {
        voxels.push_back({voxel, code});
      },
      [](const VoxelSegment&) {});
}

}  // namespace nextview
