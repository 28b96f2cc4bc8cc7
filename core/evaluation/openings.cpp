#include "core/evaluation/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

bool called_free(const Voxel& voxel) { return voxel.measured && voxel.probability < 0.5f; }
bool called_occupied(const Voxel& voxel) { return voxel.measured && voxel.probability >= 0.5f; }

/// Half the opening's width at a distance along it from its centre.
double half_width(const Opening& o, double along) {
  const double radius = 0.5 * o.width;
  return o.kind == Opening::Kind::bore ? std::sqrt(std::max(0.0, radius * radius - along * along)) : radius;
}

Vector3 across(const Opening& o) { return o.axis.cross(o.along); }

bool contains(const Opening& o, const Vector3& point) {
  const Vector3 from_centre = point - o.centre;
  const double along = o.along.dot(from_centre);
  return std::abs(o.axis.dot(from_centre)) <= 0.5 * o.depth && std::abs(along) <= 0.5 * o.length &&
         std::abs(across(o).dot(from_centre)) <= half_width(o, along);
}

/// A row is where its lines pass the middle of the wall.
using Row = std::vector<Vector3>;

std::vector<Row> rows_of(const Opening& o, double resolution) {
  const int count = std::max(1, static_cast<int>(std::floor(o.length / resolution + 1e-9)) - 2);
  std::vector<Row> rows;
  for (int r = 0; r < count; ++r) {
    const double along = (r + 0.5 - 0.5 * count) * resolution;
    const double width = 2.0 * half_width(o, along);
    const int lines = std::max(5, static_cast<int>(std::ceil(2.0 * width / resolution)));
    rows.emplace_back();
    for (int j = 0; j < lines; ++j)
      rows.back().push_back(o.centre + along * o.along + ((j + 0.5) / lines - 0.5) * width * across(o));
  }
  return rows;
}

/// Whether `holds(voxel)` is true of all voxels on the line of `half_length` to both sides of `middle`; never outside
/// of the grid.
template <class Holds>
bool all_on_line(const VoxelGrid& grid, const Vector3& middle, const Vector3& direction, double half_length,
                 Holds holds) {
  const Vector3 begin = middle - half_length * direction;
  if (!grid.contains(grid.cell_at(begin)) || !grid.contains(grid.cell_at(middle + half_length * direction)))
    return false;
  bool all = true;
  walk_ray(grid, begin, direction, 2.0 * half_length, [&](int x, int y, int z) {
    return all = holds(grid.index({x, y, z}));
  });
  return all;
}

bool is_open(const Row& row, const Opening& o, std::span<const Voxel> map, const VoxelGrid& grid) {
  return std::any_of(row.begin(), row.end(), [&](const Vector3& middle) {
    return all_on_line(grid, middle, o.axis, 0.5 * o.depth + grid.resolution,
                       [&](std::uint32_t voxel) { return called_free(map[voxel]); });
  });
}

bool is_solid(const Row& row, const Opening& o, const GroundTruth& truth) {
  const double resolution = truth.grid.resolution;
  const double half_length = std::max(0.5 * o.depth - resolution, 0.01 * resolution);
  return std::all_of(row.begin(), row.end(), [&](const Vector3& middle) {
    return all_on_line(truth.grid, middle, o.axis, half_length,
                       [&](std::uint32_t voxel) { return truth.centre[voxel]; });
  });
}

void count_recall(const Opening& o, std::span<const Voxel> map, const GroundTruth& truth, TruthConvention convention,
                  std::span<const std::uint8_t> scored, OpeningScore& score) {
  const VoxelGrid& grid = truth.grid;
  const Vector3 reach =
      0.5 * (o.depth * o.axis.cwiseAbs() + o.length * o.along.cwiseAbs() + o.width * across(o).cwiseAbs());
  const Eigen::Vector3i first = grid.cell_at(o.centre - reach).cwiseMax(0);
  const Eigen::Vector3i last = grid.cell_at(o.centre + reach).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const std::uint32_t voxel = grid.index({x, y, z});
        if ((!scored.empty() && !scored[voxel]) || !contains(o, grid.centre(voxel))) continue;
        if (voxel_truth(truth, voxel, convention) != VoxelTruth::free) continue;
        ++score.free_voxels;
        score.called_free += called_free(map[voxel]);
      }
}

void check(const Opening& o) {
  if (!(o.width > 0.0 && o.length > 0.0 && o.depth > 0.0))
    throw std::invalid_argument(fmt::format("opening: width, length and depth must be over 0 m, not {}, {} and {}",
                                            o.width, o.length, o.depth));
  if (std::abs(o.axis.norm() - 1.0) > 1e-6 || std::abs(o.along.norm() - 1.0) > 1e-6 ||
      std::abs(o.axis.dot(o.along)) > 1e-6)
    throw std::invalid_argument("opening: axis and along must be of unit length and at right angles");
}

void check_lengths(std::size_t map, const GroundTruth& truth, std::size_t scored) {
  const std::size_t voxels = truth.grid.voxel_count();
  if (map != voxels || scored != voxels)
    throw std::invalid_argument(
        fmt::format("openings: a map of {} voxels and a mask of {} for {} voxels of truth", map, scored, voxels));
}
void check_lengths(std::span<const Voxel> map, const GroundTruth& truth, std::span<const std::uint8_t> scored) {
  check_lengths(map.size(), truth, scored.empty() ? truth.grid.voxel_count() : scored.size());
}

/// `voxel_at(i)` is asked of the truly occupied voxels alone, of which there are few.
template <class VoxelAt, class Scored>
std::optional<double> recall(const GroundTruth& truth, TruthConvention convention, VoxelAt voxel_at, Scored scored) {
  std::size_t occupied = 0, found = 0;
  for (std::size_t i = 0; i < truth.grid.voxel_count(); ++i) {
    if (voxel_truth(truth, i, convention) != VoxelTruth::occupied || !scored(i)) continue;
    ++occupied;
    found += called_occupied(voxel_at(i));
  }
  return occupied == 0 ? std::nullopt : std::optional(double(found) / double(occupied));
}

}  // namespace

OpeningScore& OpeningScore::operator+=(const OpeningScore& other) {
  rows += other.rows;
  open_rows += other.open_rows;
  free_voxels += other.free_voxels;
  called_free += other.called_free;
  control_rows += other.control_rows;
  leaking_rows += other.leaking_rows;
  return *this;
}

OpeningScore score_opening(const Opening& opening, std::span<const Voxel> map, const GroundTruth& truth,
                           TruthConvention convention, std::span<const std::uint8_t> scored) {
  check(opening);
  check_lengths(map, truth, scored);
  OpeningScore score;
  for (const Row& row : rows_of(opening, truth.grid.resolution)) {
    ++score.rows;
    score.open_rows += is_open(row, opening, map, truth.grid);
  }
  count_recall(opening, map, truth, convention, scored, score);
  for (const double side : {-1.0, 1.0}) {
    Opening strip = opening;
    strip.centre += side * (opening.width + 2.0 * truth.grid.resolution) * across(opening);
    for (const Row& row : rows_of(strip, truth.grid.resolution)) {
      if (!is_solid(row, strip, truth)) continue;
      ++score.control_rows;
      score.leaking_rows += is_open(row, strip, map, truth.grid);
    }
  }
  return score;
}

std::optional<double> surface_recall(std::span<const Voxel> map, const GroundTruth& truth, TruthConvention convention,
                                     std::span<const std::uint8_t> scored) {
  check_lengths(map, truth, scored);
  return recall(
      truth, convention, [&](std::size_t i) { return map[i]; },
      [&](std::size_t i) { return scored.empty() || scored[i] != 0; });
}

std::optional<double> surface_recall(const VoxelBricks& map, const GroundTruth& truth, TruthConvention convention,
                                     const BitMask& scored) {
  check_lengths(map.size(), truth, scored.size());
  return recall(
      truth, convention, [&](std::size_t i) { return map[i]; }, [&](std::size_t i) { return scored[i]; });
}

}  // namespace nextview
