#include "core/map/ground_truth.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "core/map/bit_rows.hpp"
#include "core/mesh/line_crossing.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

using Triangle = std::array<Vector3, 3>;  // in voxels, counted from the grid's lower corner

constexpr double half_voxel = 0.5 + 1e-5;  // see GroundTruth::touch

Triangle to_grid(const TriangleMesh& mesh, std::size_t triangle, const VoxelGrid& grid) {
  Triangle corners;
  for (int k = 0; k < 3; ++k)
    corners[k] =
        mesh.vertices[mesh.triangles[triangle][k]].cast<double>() / grid.resolution - grid.first.cast<double>();
  return corners;
}

/// Rounds down after limiting to -1 .. size, so that any coordinate fits an int.
int clamped_floor(double value, int size) {
  return static_cast<int>(std::floor(std::clamp(value, -1.0, double(size))));
}

template <class Body>
void for_each_triangle(const TriangleMesh& mesh, const VoxelGrid& grid, const std::stop_token& stop, Body body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), 64), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end() && !stop.stop_requested(); ++t) body(to_grid(mesh, t, grid));
  });
  throw_if_stopped(stop);
}

/// An axis that may separate a triangle from voxels: voxels whose centre projects outside of [low, high] do not meet
/// the triangle.
struct SeparatingAxis {
  Vector3 direction;
  double low, high;
};

/// The triangle's normal and the cross products of its edges with the voxel's (Akenine-Moeller 2001); the voxel's own
/// three axes are the bounds of the range of voxels that is looked at.
std::array<SeparatingAxis, 10> separating_axes(const Triangle& t) {
  std::array<SeparatingAxis, 10> axes;
  const std::array<Vector3, 3> edges = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  axes[0].direction = edges[0].cross(edges[1]);
  for (int e = 0; e < 3; ++e)
    for (int k = 0; k < 3; ++k) axes[1 + 3 * e + k].direction = edges[e].cross(Vector3::Unit(k));
  for (SeparatingAxis& axis : axes) {
    const auto [low, high] =
        std::minmax({axis.direction.dot(t[0]), axis.direction.dot(t[1]), axis.direction.dot(t[2])});
    const double radius = half_voxel * axis.direction.lpNorm<1>();
    axis.low = low - radius;
    axis.high = high + radius;
  }
  return axes;
}

void mark_touched(const Triangle& t, const VoxelGrid& grid, BitRows& touch) {
  Eigen::Vector3i first, last;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax({t[0][k], t[1][k], t[2][k]});
    first[k] = std::max(0, clamped_floor(low + 0.5 - half_voxel, grid.size[k]));
    last[k] = std::min(grid.size[k] - 1, clamped_floor(high - 0.5 + half_voxel, grid.size[k]));
  }
  const auto axes = separating_axes(t);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const Vector3 centre(x + 0.5, y + 0.5, z + 0.5);
        const bool apart = std::any_of(axes.begin(), axes.end(), [&](const SeparatingAxis& axis) {
          const double at = axis.direction.dot(centre);
          return at < axis.low || at > axis.high;
        });
        if (!apart) touch.set({x, y, z});
      }
}

/// Toggles, in each column along `axis` that crosses the triangle, the first voxel whose centre is behind the crossing
/// (above the grid: the column's parity alone).
void mark_crossings(const Triangle& t, const VoxelGrid& grid, int axis, BitRows& toggles, BitRows& parity) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto [u_low, u_high] = std::minmax({t[0][u], t[1][u], t[2][u]});
  const auto [v_low, v_high] = std::minmax({t[0][v], t[1][v], t[2][v]});
  const int u_first = std::max(0, clamped_floor(u_low - 0.5, grid.size[u])),
            v_first = std::max(0, clamped_floor(v_low - 0.5, grid.size[v]));
  const int u_last = std::min(grid.size[u] - 1, clamped_floor(u_high, grid.size[u]));
  const int v_last = std::min(grid.size[v] - 1, clamped_floor(v_high, grid.size[v]));
  for (int j = v_first; j <= v_last; ++j)
    for (int i = u_first; i <= u_last; ++i) {
      const std::optional<double> crossing = line_crossing(t, axis, {i + 0.5, j + 0.5});
      if (!crossing) continue;
      Eigen::Vector3i cell;
      cell[u] = i;
      cell[v] = j;
      cell[axis] = 0;
      parity.flip(cell);
      cell[axis] = std::max(0, clamped_floor(*crossing - 0.5, grid.size[axis]) + 1);
      if (cell[axis] < grid.size[axis]) toggles.flip(cell);
    }
}

/// Which voxels' centres are inside, as seen along `axis`. A column that enters and does not leave says 'outside':
/// there is a hole in the mesh.
BitRows inside_along(const TriangleMesh& mesh, const VoxelGrid& grid, int axis, const std::stop_token& stop) {
  Eigen::Vector3i across = grid.size;
  across[axis] = 1;
  BitRows toggles(grid.size), parity(across);
  for_each_triangle(mesh, grid, stop, [&](const Triangle& t) { mark_crossings(t, grid, axis, toggles, parity); });
  toggles.accumulate(axis, parity, stop);
  return toggles;
}

}  // namespace

int GroundTruth::surface_distance(std::size_t voxel) const {
  const Eigen::Vector3i cell = grid.cell(static_cast<std::uint32_t>(voxel));
  int nearest = 255;
  touch.for_each([&](std::size_t touched) {
    nearest = std::min(nearest, (grid.cell(static_cast<std::uint32_t>(touched)) - cell).cwiseAbs().maxCoeff());
  });
  return nearest;
}

GroundTruth ground_truth(const TriangleMesh& mesh, const VoxelGrid& grid, const std::stop_token& stop) {
  GroundTruth truth;
  truth.grid = grid;
  BitRows touch(grid.size);
  for_each_triangle(mesh, grid, stop, [&](const Triangle& t) { mark_touched(t, grid, touch); });
  truth.touch = touch.mask();
  for (int voxels = 0; voxels < band_width; ++voxels) touch.grow(stop);
  truth.near_surface = touch.mask();
  truth.centre = BitRows::majority(inside_along(mesh, grid, 0, stop), inside_along(mesh, grid, 1, stop),
                                   inside_along(mesh, grid, 2, stop))
                     .mask();
  return truth;
}

}  // namespace nextview
