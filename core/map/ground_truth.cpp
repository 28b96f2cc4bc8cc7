#include "core/map/ground_truth.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

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

void mark_touched(const Triangle& t, const VoxelGrid& grid, std::vector<std::uint8_t>& touch) {
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
        // Several triangles may touch one voxel; they all write the same.
        if (!apart) std::atomic_ref(touch[grid.index({x, y, z})]).store(1, std::memory_order_relaxed);
      }
}

/// Toggles, in each column along `axis` that crosses the triangle, the first voxel whose centre is behind the crossing
/// (above the grid: the column's parity alone).
void mark_crossings(const Triangle& t, const VoxelGrid& grid, int axis, std::vector<std::uint8_t>& toggles,
                    std::vector<std::uint8_t>& parity) {
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
      cell[axis] = std::max(0, clamped_floor(*crossing - 0.5, grid.size[axis]) + 1);
      std::atomic_ref(parity[std::size_t(j) * grid.size[u] + i]).fetch_xor(1, std::memory_order_relaxed);
      if (cell[axis] < grid.size[axis])
        std::atomic_ref(toggles[grid.index(cell)]).fetch_xor(1, std::memory_order_relaxed);
    }
}

/// Adds one vote to every voxel whose centre is inside, as seen along `axis`.
void vote_inside(const TriangleMesh& mesh, const VoxelGrid& grid, int axis, const std::stop_token& stop,
                 std::vector<std::uint8_t>& votes) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<std::uint8_t> toggles(grid.voxel_count(), 0), parity(std::size_t(grid.size[u]) * grid.size[v], 0);
  for_each_triangle(mesh, grid, stop, [&](const Triangle& t) { mark_crossings(t, grid, axis, toggles, parity); });
  const std::size_t step = axis == 0 ? 1 : axis == 1 ? grid.size.x() : std::size_t(grid.size.x()) * grid.size.y();
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size[v]), [&](const auto& range) {
    for (int j = range.begin(); j != range.end() && !stop.stop_requested(); ++j)
      for (int i = 0; i < grid.size[u]; ++i) {
        if (parity[std::size_t(j) * grid.size[u] + i]) continue;  // enters and does not leave: a hole in the mesh
        Eigen::Vector3i cell = Eigen::Vector3i::Zero();
        cell[u] = i;
        cell[v] = j;
        std::uint8_t inside = 0;
        std::size_t voxel = grid.index(cell);
        for (int k = 0; k < grid.size[axis]; ++k, voxel += step) votes[voxel] += inside ^= toggles[voxel];
      }
  });
  throw_if_stopped(stop);
}

/// One of the two passes of the distance transform: every row takes the least of its own values and its neighbours'
/// before it in the order of the pass, plus one. With all 26 neighbours this is exact for the Chebyshev distance
/// (Rosenfeld and Pfaltz 1966).
void sweep(const VoxelGrid& grid, int direction, const std::stop_token& stop, std::vector<std::uint8_t>& distance) {
  const int nx = grid.size.x(), ny = grid.size.y(), nz = grid.size.z();
  std::vector<std::uint8_t> nearest(nx + 2, 255);  // of the rows before; one voxel more at each end
  const auto plus_one = [](std::uint8_t d) { return static_cast<std::uint8_t>(std::min<int>(d, 254) + 1); };
  for (int k = 0; k < nz; ++k) {
    throw_if_stopped(stop);
    for (int j = 0; j < ny; ++j) {
      const int z = direction > 0 ? k : nz - 1 - k, y = direction > 0 ? j : ny - 1 - j;
      std::fill(nearest.begin(), nearest.end(), 255);
      const std::array<std::array<int, 2>, 4> before = {
          {{y - 1, z - direction}, {y, z - direction}, {y + 1, z - direction}, {y - direction, z}}};
      for (const auto& [row_y, row_z] : before) {
        if (row_y < 0 || row_y >= ny || row_z < 0 || row_z >= nz) continue;
        const std::uint8_t* row = &distance[grid.index({0, row_y, row_z})];
        for (int x = 0; x < nx; ++x) nearest[x + 1] = std::min(nearest[x + 1], row[x]);
      }
      std::uint8_t* row = &distance[grid.index({0, y, z})];
      for (int x = 0; x < nx; ++x)
        row[x] = std::min(row[x], plus_one(std::min({nearest[x], nearest[x + 1], nearest[x + 2]})));
      std::uint8_t previous = 255;
      for (int i = 0; i < nx; ++i) {
        std::uint8_t& own = row[direction > 0 ? i : nx - 1 - i];
        previous = own = std::min(own, plus_one(previous));
      }
    }
  }
}

}  // namespace

GroundTruth ground_truth(const TriangleMesh& mesh, const VoxelGrid& grid, const std::stop_token& stop) {
  GroundTruth truth;
  truth.grid = grid;
  truth.touch.assign(grid.voxel_count(), 0);
  for_each_triangle(mesh, grid, stop, [&](const Triangle& t) { mark_touched(t, grid, truth.touch); });

  truth.centre.assign(grid.voxel_count(), 0);
  for (int axis = 0; axis < 3; ++axis) vote_inside(mesh, grid, axis, stop, truth.centre);
  for (std::uint8_t& votes : truth.centre) votes = votes >= 2;

  truth.surface_distance.resize(grid.voxel_count());
  std::transform(truth.touch.begin(), truth.touch.end(), truth.surface_distance.begin(),
                 [](std::uint8_t touched) { return touched ? 0 : 255; });
  sweep(grid, +1, stop, truth.surface_distance);
  sweep(grid, -1, stop, truth.surface_distance);
  return truth;
}

}  // namespace nextview
