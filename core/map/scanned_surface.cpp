#include "core/map/scanned_surface.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace nextview {
namespace {

constexpr int divisions = 4;  // of a cell along each axis
constexpr int sub_cell_count = divisions * divisions * divisions;

/// Places beyond are taken for the last one: that is thousands of kilometres, or a radius that is next to nothing.
constexpr int farthest = (1 << 20) - 3;  // two cells on there are keys, too

/// Where the cell of this key is in the table, or has its place if there is none.
template <class Slot>
std::size_t slot_of(std::uint64_t key, const std::vector<Slot>& slots) {
  const std::size_t last = slots.size() - 1;
  std::size_t slot = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & last;
  while (slots[slot].key != 0 && slots[slot].key != key) slot = (slot + 1) & last;
  return slot;
}

/// The cells around a cell, itself first.
const std::array<Eigen::Vector3i, 27> neighbours = [] {
  std::array<Eigen::Vector3i, 27> all;
  for (int i = 0; i < 27; ++i) all[i] = Eigen::Vector3i(i % 3, i / 3 % 3, i / 9) - Eigen::Vector3i::Ones();
  std::ranges::stable_sort(all, {}, [](const Eigen::Vector3i& n) { return n.squaredNorm(); });
  return all;
}();

Eigen::Vector3i sub_cell_at(int i) { return {i % divisions, i / divisions % divisions, i / divisions / divisions}; }

/// Of each sub-cell, and each neighbour: which of its sub-cells lie within the radius, from middle to middle.
const auto within_radius = [] {
  std::array<std::array<std::uint64_t, 27>, sub_cell_count> masks{};
  for (int from = 0; from < sub_cell_count; ++from)
    for (std::size_t n = 0; n < neighbours.size(); ++n)
      for (int to = 0; to < sub_cell_count; ++to) {
        const Eigen::Vector3i way = divisions * neighbours[n] + sub_cell_at(to) - sub_cell_at(from);
        if (way.squaredNorm() <= divisions * divisions) masks[from][n] |= std::uint64_t{1} << to;
      }
  return masks;
}();

}  // namespace

Eigen::Vector3i ScannedSurface::cell_of(std::uint64_t key) {
  constexpr std::uint64_t part = (1 << 21) - 1;
  const auto at = [&](int shift) { return int(((key - 1) >> shift) & part) - offset; };
  return {at(0), at(21), at(42)};
}

Eigen::Vector3f ScannedSurface::Cell::middle() const {
  // Those whose place along an axis is odd, and those where it is 2 or 3.
  constexpr std::array<std::uint64_t, 3> odd = {0xaaaaaaaaaaaaaaaa, 0xf0f0f0f0f0f0f0f0, 0xffff0000ffff0000};
  constexpr std::array<std::uint64_t, 3> high = {0xcccccccccccccccc, 0xff00ff00ff00ff00, 0xffffffff00000000};
  const auto count = float(std::popcount(points));
  Eigen::Vector3f middle = at.cast<float>();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int sum = std::popcount(points & odd[axis]) + 2 * std::popcount(points & high[axis]);
    middle[Eigen::Index(axis)] += (float(sum) / count + 0.5f) / divisions;
  }
  return middle;
}

ScannedSurface::ScannedSurface(double radius) : radius_(radius), slots_(1024) {
  if (!(radius > 0.0)) throw std::invalid_argument("scanned surface: the radius must be greater than 0");
}

double ScannedSurface::add(const Scan& scan, const Vector3& optical_axis, double central_solid_angle) {
  std::vector<Place> places(scan.hits.size());
  std::vector<double> areas(scan.hits.size(), 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      places[i] = place(scan.hits[i]);
      if (!is_new(places[i])) continue;
      const Vector3 way = scan.hits[i].cast<double>() - scan.origin;
      const double depth = std::max(0.0, way.dot(optical_axis)), distance = way.norm();
      // A pixel's solid angle falls with the cube of the cosine.
      if (distance > 0.0) areas[i] = central_solid_angle * depth * depth * depth / distance;
    }
  });
  const auto known = static_cast<std::ptrdiff_t>(keys_.size());
  for (const Place& place : places)
    if (mark(place)) keys_.push_back(key_of(place.cell));
  tbb::parallel_sort(keys_.begin() + known, keys_.end());
  std::inplace_merge(keys_.begin(), keys_.begin() + known, keys_.end());
  double area = 0.0;
  for (const double a : areas) area += a;
  area_ += area;
  return area;
}

ScannedSurface::Place ScannedSurface::place(const Eigen::Vector3f& point) const {
  Place place{{}, 0};
  for (int axis = 2; axis >= 0; --axis) {
    const double at = std::clamp(point[axis] / radius_, -double(farthest), double(farthest));
    place.cell[axis] = static_cast<int>(std::floor(at));
    const int part = static_cast<int>((at - place.cell[axis]) * divisions);
    place.sub_cell = place.sub_cell * divisions + std::min(part, divisions - 1);
  }
  return place;
}

bool ScannedSurface::is_new(const Place& place) const {
  const auto& masks = within_radius[static_cast<std::size_t>(place.sub_cell)];
  for (std::size_t n = 0; n < neighbours.size(); ++n)
    if (masks[n] & sub_cells(place.cell + neighbours[n])) return false;
  return true;
}

int ScannedSurface::points_around(const Place& place) const {
  const auto& masks = within_radius[static_cast<std::size_t>(place.sub_cell)];
  int count = 0;
  for (std::size_t n = 0; n < neighbours.size(); ++n)
    if (masks[n]) count += std::popcount(masks[n] & sub_cells(place.cell + neighbours[n]));
  return count;
}

std::vector<Eigen::Vector3f> ScannedSurface::sparse_points(double share) const {
  std::vector<Place> places;
  for (const Cell& cell : cells())
    for (int s = 0; s < sub_cell_count; ++s)
      if (cell.points >> s & 1) places.push_back({cell.at, s});
  std::vector<int> counts(places.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, counts.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) counts[i] = points_around(places[i]);
  });
  std::vector<int> sorted = counts;
  const auto median = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  std::vector<Eigen::Vector3f> sparse;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (counts[i] >= share * *median) continue;
    const Vector3 at = places[i].cell.cast<double>() +
                       (sub_cell_at(places[i].sub_cell).cast<double>() + Vector3::Constant(0.5)) / divisions;
    sparse.push_back((radius_ * at).cast<float>());
  }
  return sparse;
}

std::vector<ScannedSurface::Cell> ScannedSurface::cells() const {
  std::vector<Cell> cells(keys_.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      cells[i] = {cell_of(keys_[i]), slots_[slot_of(keys_[i], slots_)].sub_cells};
  });
  return cells;
}

std::uint64_t ScannedSurface::sub_cells(const Eigen::Vector3i& cell) const {
  return slots_[slot_of(key_of(cell), slots_)].sub_cells;
}

bool ScannedSurface::mark(const Place& place) {
  if (2 * keys_.size() >= slots_.size()) grow();
  const std::uint64_t key = key_of(place.cell);
  Slot& slot = slots_[slot_of(key, slots_)];
  const bool is_first = slot.key == 0;
  slot.key = key;
  slot.sub_cells |= std::uint64_t{1} << place.sub_cell;
  return is_first;
}

void ScannedSurface::grow() {
  std::vector<Slot> before(2 * slots_.size());
  std::swap(before, slots_);
  for (const Slot& slot : before)
    if (slot.key != 0) slots_[slot_of(slot.key, slots_)] = slot;
}

void ScannedSurface::archive(ByteWriter& writer) const {
  std::vector<std::uint64_t> numbers;
  for (const Slot& slot : slots_) numbers.insert(numbers.end(), {slot.key, slot.sub_cells});
  writer(area_, numbers);
}

void ScannedSurface::archive(ByteReader& reader) {
  double area = 0.0;
  std::vector<std::uint64_t> numbers;
  reader(area, numbers);
  std::vector<Slot> slots;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) slots.push_back({numbers[i], numbers[i + 1]});
  std::vector<std::uint64_t> keys;
  for (const Slot& slot : slots)
    if (slot.key != 0) keys.push_back(slot.key);
  std::ranges::sort(keys);
  // A full table would be searched for ever.
  bool is_table = numbers.size() % 2 == 0 && std::has_single_bit(slots.size()) && keys.size() <= slots.size() / 2 &&
                  slots.size() >= 1024 && std::isfinite(area);
  for (std::size_t i = 0; is_table && i < slots.size(); ++i)  // each cell is where it is looked for, and so there once
    is_table = slots[i].key == 0 || slot_of(slots[i].key, slots) == i;
  if (!is_table) throw std::runtime_error("it holds no scanned surface");
  area_ = area;
  slots_ = std::move(slots);
  keys_ = std::move(keys);
}

}  // namespace nextview
