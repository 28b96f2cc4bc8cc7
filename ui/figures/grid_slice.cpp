#include "ui/figures/grid_slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nextview {
namespace {

/// Width over height of a slice that is framed here: that of the figures' panels, so that voxels come out large.
constexpr double aspect = 1.48;
/// Free around what is framed [voxels].
constexpr double object_margin = 4, opening_margin = 16;

/// Frames a box of the layer [voxels], widened to the aspect, within the grid.
GridSlice framed(GridSlice slice, const VoxelGrid& grid, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d size = box.sizes();
  const double wide = std::max(size.x(), aspect * size.y());
  const int columns = grid.size[slice.right_axis()], rows = grid.size[slice.up_axis()];
  slice.width = std::clamp(static_cast<int>(std::ceil(wide)), 1, columns);
  slice.height = std::clamp(static_cast<int>(std::ceil(wide / aspect - 0.5)), 1, rows);
  const Eigen::Vector2d centre = box.center();
  slice.left = std::clamp(static_cast<int>(std::lround(centre.x() - 0.5 * slice.width)), 0, columns - slice.width);
  slice.bottom = std::clamp(static_cast<int>(std::lround(centre.y() - 0.5 * slice.height)), 0, rows - slice.height);
  return slice;
}

/// What lies in the layer, right and up, of a place or a direction.
Eigen::Vector2d in_layer(const GridSlice& slice, const Vector3& v) {
  return {v[slice.right_axis()], v[slice.up_axis()]};
}

bool called_occupied(const Voxel& voxel) { return voxel.measured && voxel.probability >= 0.5f; }

}  // namespace

std::uint32_t GridSlice::voxel(const VoxelGrid& grid, int right, int up) const {
  Eigen::Vector3i cell;
  cell[axis] = index;
  cell[right_axis()] = left + right;
  cell[up_axis()] = bottom + up;
  return grid.index(cell);
}

double GridSlice::position(const VoxelGrid& grid) const { return (grid.first[axis] + index + 0.5) * grid.resolution; }

void GridSlice::check(const VoxelGrid& grid) const {
  const bool fits = axis >= 0 && axis < 3 && index >= 0 && index < grid.size[axis] && left >= 0 && bottom >= 0 &&
                    width > 0 && height > 0 && left + width <= grid.size[right_axis()] &&
                    bottom + height <= grid.size[up_axis()];
  if (!fits)
    throw std::invalid_argument(
        fmt::format("slice: layer {} of axis {}, voxels {} + {} by {} + {}, is not within a grid of {} x {} x {}",
                    index, axis, left, width, bottom, height, grid.size.x(), grid.size.y(), grid.size.z()));
}

GridSlice whole_layer(const VoxelGrid& grid, int axis, int index) {
  GridSlice slice{axis, index, 0, 0, 0, 0};
  slice.width = grid.size[slice.right_axis()];
  slice.height = grid.size[slice.up_axis()];
  return slice;
}

GridSlice slice_across(const Opening& opening, const VoxelGrid& grid) {
  GridSlice slice;
  opening.along.cwiseAbs().maxCoeff(&slice.axis);
  slice.index = std::clamp(grid.cell_at(opening.centre)[slice.axis], 0, grid.size[slice.axis] - 1);
  const Vector3 across = opening.axis.cross(opening.along);
  const Vector3 reach = (0.5 * opening.width / grid.resolution + opening_margin) * across.cwiseAbs() +
                        (0.5 * opening.depth / grid.resolution + object_margin) * opening.axis.cwiseAbs();
  const Eigen::Vector2d centre = in_layer(slice, (opening.centre - grid.lower()) / grid.resolution);
  return framed(slice, grid, {centre - in_layer(slice, reach), centre + in_layer(slice, reach)});
}

GridSlice slice_of_largest_difference(const VoxelGrid& grid, std::span<const Voxel> one, std::span<const Voxel> other) {
  std::array<std::vector<double>, 3> sums;
  for (int axis = 0; axis < 3; ++axis) sums[axis].assign(grid.size[axis], 0.0);
  // Free space differs most, by its volume; what the surface looks like is the question.
  const auto occupied_in_either = [&](std::uint32_t i) { return called_occupied(one[i]) || called_occupied(other[i]); };
  bool any = false;
  for (std::uint32_t i = 0; i < one.size() && !any; ++i) any = occupied_in_either(i);
  for (std::uint32_t i = 0; i < one.size(); ++i) {
    if (any && !occupied_in_either(i)) continue;
    const Eigen::Vector3i cell = grid.cell(i);
    const double difference = std::abs(one[i].probability - other[i].probability);
    for (int axis = 0; axis < 3; ++axis) sums[axis][cell[axis]] += difference;
  }
  GridSlice slice{0, 0, 0, 0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    for (int index = 0; index < grid.size[axis]; ++index)
      if (sums[axis][index] > sums[slice.axis][slice.index]) slice.axis = axis, slice.index = index;
  slice = whole_layer(grid, slice.axis, slice.index);

  Eigen::AlignedBox2d occupied;
  for (int up = 0; up < slice.height; ++up)
    for (int right = 0; right < slice.width; ++right) {
      const std::uint32_t voxel = slice.voxel(grid, right, up);
      if (!occupied_in_either(voxel)) continue;
      occupied.extend(Eigen::Vector2d(right, up));
      occupied.extend(Eigen::Vector2d(right + 1, up + 1));
    }
  if (occupied.isEmpty()) return slice;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(object_margin);
  return framed(slice, grid, {occupied.min() - margin, occupied.max() + margin});
}

std::vector<LinePiece> cross_section(const TriangleMesh& mesh, const VoxelGrid& grid, const GridSlice& slice) {
  const double plane = slice.position(grid);
  std::vector<LinePiece> pieces;
  for (const auto& triangle : mesh.triangles) {
    LinePiece piece;
    int met = 0;
    for (int edge = 0; edge < 3; ++edge) {
      const Vector3 a = mesh.vertices[triangle[edge]].cast<double>();
      const Vector3 b = mesh.vertices[triangle[(edge + 1) % 3]].cast<double>();
      // A corner on the plane counts as above it: then either two edges cross the plane, or none does.
      if ((a[slice.axis] < plane) == (b[slice.axis] < plane)) continue;
      const Vector3 at = a + (plane - a[slice.axis]) / (b[slice.axis] - a[slice.axis]) * (b - a);
      piece[met++] = in_layer(slice, (at - grid.lower()) / grid.resolution);
    }
    if (met == 2) pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace nextview
