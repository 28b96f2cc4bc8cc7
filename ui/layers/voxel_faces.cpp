#include "ui/layers/voxel_faces.hpp"

#include <tbb/parallel_for.h>

#include <bit>
#include <limits>
#include <stdexcept>

#include "core/map/traversal.hpp"
#include "ui/layers/shown_voxels.hpp"

namespace nextview {
namespace {

/// The axes along a face's edges: right-handed around the outward normal, so exchanged on the negative side.
struct FaceAxes {
  int u, v;
  explicit FaceAxes(int side) {
    const int axis = side / 2, positive = side % 2;
    u = (axis + (positive ? 1 : 2)) % 3;
    v = (axis + (positive ? 2 : 1)) % 3;
  }
};

bool far_along_u(int corner) { return corner == 1 || corner == 2; }
bool far_along_v(int corner) { return corner >= 2; }

/// Of 64 voxels, those with an exposed face, by side.
struct ExposedWord {
  std::array<std::uint64_t, 6> sides;

  ExposedWord(const ShownVoxels& shown, int word, int y, int z) {
    const std::uint64_t* row = shown.row(y, z);
    const std::uint64_t here = row[word];
    const std::uint64_t before = word > 0 ? row[word - 1] >> 63 : 0;
    const std::uint64_t after = word + 1 < shown.words_per_row() ? row[word + 1] << 63 : 0;
    sides = {here & ~(here << 1 | before),      here & ~(here >> 1 | after),       here & ~shown.row(y - 1, z)[word],
             here & ~shown.row(y + 1, z)[word], here & ~shown.row(y, z - 1)[word], here & ~shown.row(y, z + 1)[word]};
  }
  std::uint64_t any() const { return sides[0] | sides[1] | sides[2] | sides[3] | sides[4] | sides[5]; }
  std::size_t count() const {
    std::size_t sum = 0;
    for (const std::uint64_t side : sides) sum += std::size_t(std::popcount(side));
    return sum;
  }
};

/// Of the three voxels around a corner in the layer before the face: the two beside the face, and the one between
/// these.
std::uint8_t corner_occlusion(const ShownVoxels& shown, const Eigen::Vector3i& cell, int side) {
  const FaceAxes axes(side);
  Eigen::Vector3i before = cell;
  before[side / 2] += side % 2 ? 1 : -1;
  const auto there = [&](int du, int dv) {
    Eigen::Vector3i at = before;
    at[axes.u] += du;
    at[axes.v] += dv;
    return shown.at(at.x(), at.y(), at.z());
  };
  const std::array<bool, 2> along_u{there(-1, 0), there(1, 0)}, along_v{there(0, -1), there(0, 1)};
  std::uint8_t occlusion = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const bool u = far_along_u(corner), v = far_along_v(corner);
    const bool nook = along_u[u] && along_v[v];  // what is between the two then changes nothing
    const int level = nook ? 3 : int(along_u[u]) + int(along_v[v]) + int(there(u ? 1 : -1, v ? 1 : -1));
    occlusion |= std::uint8_t(level << (2 * corner));
  }
  return occlusion;
}

void write_faces(const VoxelGrid& grid, const ShownVoxels& shown, int z, VoxelFace* out) {
  for (int y = 0; y < grid.size.y(); ++y) {
    for (int word = 0; word < shown.words_per_row(); ++word) {
      if (shown.row(y, z)[word] == 0) continue;
      const ExposedWord exposed(shown, word, y, z);
      for (std::uint64_t left = exposed.any(); left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        const Eigen::Vector3i cell(64 * word + bit, y, z);
        for (std::uint8_t side = 0; side < 6; ++side) {
          if (exposed.sides[side] >> bit & 1) *out++ = {grid.index(cell), side, corner_occlusion(shown, cell, side)};
        }
      }
    }
  }
}

}  // namespace

std::vector<VoxelFace> exposed_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter) {
  if (voxels.size() != grid.voxel_count()) throw std::invalid_argument("voxels: their number is not the grid's");
  if (filter.shows_nothing()) return {};
  const ShownVoxels shown(grid, voxels, filter);
  // First how many faces each layer has, then each layer writes to its place.
  std::vector<std::size_t> first(std::size_t(grid.size.z()) + 1, 0);
  tbb::parallel_for(0, grid.size.z(), [&](int z) {
    std::size_t count = 0;
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int word = 0; word < shown.words_per_row(); ++word) {
        if (shown.row(y, z)[word] != 0) count += ExposedWord(shown, word, y, z).count();
      }
    }
    first[std::size_t(z) + 1] = count;
  });
  for (std::size_t z = 1; z < first.size(); ++z) first[z] += first[z - 1];
  std::vector<VoxelFace> faces(first.back());
  tbb::parallel_for(0, grid.size.z(),
                    [&](int z) { write_faces(grid, shown, z, faces.data() + first[std::size_t(z)]); });
  return faces;
}

std::array<Vector3, 4> face_corners(const VoxelGrid& grid, const VoxelFace& face) {
  const FaceAxes axes(face.side);
  Eigen::Vector3i lowest = grid.first + grid.cell(face.voxel);
  lowest[face.side / 2] += face.side % 2;
  std::array<Vector3, 4> result;
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::Vector3i at = lowest;
    at[axes.u] += far_along_u(corner);
    at[axes.v] += far_along_v(corner);
    result[corner] = at.cast<double>() * grid.resolution;
  }
  return result;
}

Vector3 face_normal(const VoxelFace& face) { return (face.side % 2 ? 1.0 : -1.0) * Vector3::Unit(face.side / 2); }

std::optional<std::uint32_t> voxel_on_ray(const Vector3& origin, const Vector3& direction, const VoxelGrid& grid,
                                          std::span<const Voxel> voxels, const VoxelFilter& filter) {
  if (voxels.size() != grid.voxel_count()) throw std::invalid_argument("voxels: their number is not the grid's");
  if (direction.isZero(0.0)) throw std::invalid_argument("ray: it has no direction");
  std::optional<std::uint32_t> met;
  walk_ray(grid, origin, direction.normalized(), std::numeric_limits<double>::infinity(), [&](int x, int y, int z) {
    const std::uint32_t voxel = grid.index({x, y, z});
    if (filter.shows(grid, voxel, voxels[voxel])) met = voxel;
    return !met;
  });
  return met;
}

}  // namespace nextview
