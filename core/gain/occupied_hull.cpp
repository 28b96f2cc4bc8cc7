#include "core/gain/occupied_hull.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/map/brick_kinds.hpp"

namespace nextview {
namespace {

constexpr double outlier_share = 0.001;

/// How far along each of the hull's directions a cell lies: the axes, and the diagonals between two of them.
std::array<int, 9> along_directions(const Eigen::Vector3i& cell) {
  const int x = cell.x(), y = cell.y(), z = cell.z();
  return {x, y, z, x + y, x - y, x + z, x - z, y + z, y - z};
}

/// How many occupied voxels lie how far along each of the hull's directions.
class OccupiedCounts {
 public:
  explicit OccupiedCounts(const Eigen::Vector3i& edges) : behind_(edges.maxCoeff()) {
    for (std::vector<std::uint32_t>& counts : along_) counts.resize(3 * std::size_t(behind_));  // x - y is the least
  }
  std::uint32_t count = 0;

  void add(const Eigen::Vector3i& cell) {
    const std::array<int, 9> along = along_directions(cell);
    for (std::size_t d = 0; d < along.size(); ++d) {
      const int place = along[d] + behind_;
      ++along_[d][std::size_t(place)];
    }
    ++count;
  }
  void add(const OccupiedCounts& others) {
    for (std::size_t d = 0; d < along_.size(); ++d)
      std::ranges::transform(along_[d], others.along_[d], along_[d].begin(), std::plus());
    count += others.count;
  }
  /// From where to where along a direction they are, without the outliers at both ends.
  std::pair<int, int> bounds(int direction) const {
    const auto outliers = static_cast<std::uint32_t>(outlier_share * double(count));
    const std::vector<std::uint32_t>& counts = along_[std::size_t(direction)];
    const auto place_of = [&](std::uint32_t number) {  // of the voxel that has so many before it
      std::size_t place = 0;
      for (std::uint32_t passed = counts[0]; passed <= number; passed += counts[place]) ++place;
      return int(place) - behind_;
    };
    return {place_of(outliers), place_of(count - 1 - outliers)};
  }

 private:
  int behind_;  ///< the count of 0 has so many before it
  std::array<std::vector<std::uint32_t>, 9> along_;
};

OccupiedCounts occupied_counts(const VoxelBricks& voxels, double threshold) {
  tbb::enumerable_thread_specific<OccupiedCounts> of_threads(voxels.edges());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count(), 64), [&](const auto& range) {
    BrickKinds kinds(threshold);
    OccupiedCounts& occupied = of_threads.local();
    for (std::size_t brick = range.begin(); brick != range.end(); ++brick) {
      if (voxels.is_untouched(brick)) continue;
      kinds.read(*voxels.bricks()[brick]);
      const Eigen::Vector3i lowest = voxels.cell(brick * VoxelBricks::brick_voxels);
      for (int row = 0; row < int(kinds.occupied.size()); ++row)
        for (unsigned bits = kinds.occupied[std::size_t(row)]; bits != 0; bits &= bits - 1)
          occupied.add(lowest + BrickKinds::cell(row) + std::countr_zero(bits) * Eigen::Vector3i::UnitX());
    }
  });
  OccupiedCounts all(voxels.edges());
  for (const OccupiedCounts& some : of_threads) all.add(some);
  return all;
}

}  // namespace

double OccupiedHull::outside(const Eigen::Vector3i& cell) const {
  constexpr double of_diagonal = std::numbers::sqrt2 / 2;
  const std::array<int, directions> along = along_directions(cell);
  int by_axes = beyond(0, along[0]), by_diagonals = beyond(3, along[3]);
  for (int d = 1; d < 3; ++d) by_axes = std::max(by_axes, beyond(d, along[d]));
  for (int d = 4; d < directions; ++d) by_diagonals = std::max(by_diagonals, beyond(d, along[d]));
  return std::max(double(by_axes), of_diagonal * by_diagonals);
}

std::optional<OccupiedHull> occupied_hull(const VoxelBricks& voxels, double occupancy_threshold) {
  const OccupiedCounts occupied = occupied_counts(voxels, occupancy_threshold);
  if (occupied.count == 0) return std::nullopt;
  OccupiedHull hull;
  for (int d = 0; d < OccupiedHull::directions; ++d)
    std::tie(hull.lowest[std::size_t(d)], hull.highest[std::size_t(d)]) = occupied.bounds(d);
  return hull;
}

}  // namespace nextview
