#include "core/surface/solid_voxels.hpp"

#include <algorithm>
#include <array>

namespace nextview {
namespace {

constexpr std::size_t min_trusted = 4;  ///< occupied voxels side by side; fewer are stray hits
constexpr std::size_t fewest_thin = 4;  ///< on something thick; fewer are specks [voxels]

/// What is connected to what: over faces, or over faces, edges and corners.
enum class Neighbours { faces, all };

/// Calls `visit(neighbour)` for the neighbours of a voxel that lie in the grid.
template <class Visit>
void for_each_neighbour(const VoxelGrid& grid, std::uint32_t voxel, Neighbours neighbours, Visit visit) {
  const Eigen::Vector3i cell = grid.cell(voxel);
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
        if (steps == 0 || (neighbours == Neighbours::faces && steps > 1)) continue;
        const Eigen::Vector3i other = cell + Eigen::Vector3i(dx, dy, dz);
        if (grid.contains(other)) visit(grid.index(other));
      }
}

/// Calls `visit(piece)` with the voxels of each connected piece of those that `belongs` is true for.
template <class Belongs, class Visit>
void for_each_piece(const VoxelGrid& grid, Neighbours neighbours, Belongs belongs, Visit visit) {
  std::vector<std::uint8_t> done(grid.voxel_count());
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < done.size(); ++start) {
    if (done[start] || !belongs(start)) continue;
    done[start] = 1;
    piece.assign(1, start);
    for (std::size_t next = 0; next < piece.size(); ++next)
      for_each_neighbour(grid, piece[next], neighbours, [&](std::uint32_t v) {
        if (done[v] || !belongs(v)) return;
        done[v] = 1;
        piece.push_back(v);
      });
    visit(piece);
  }
}

bool at_border(const VoxelGrid& grid, std::uint32_t voxel) {
  const Eigen::Vector3i cell = grid.cell(voxel);
  return (cell.array() == 0).any() || (cell.array() == grid.size.array() - 1).any();
}

/// Free pockets that do not reach the region's border become solid. The largest stays in any case: a region may end
/// where nothing was measured.
void close_pockets(const VoxelGrid& grid, std::vector<float>& solid) {
  std::vector<std::vector<std::uint32_t>> pockets;
  std::vector<std::uint32_t> largest;
  std::size_t largest_size = 0;
  for_each_piece(
      grid, Neighbours::faces, [&](std::uint32_t v) { return solid[v] < solid_from; },
      [&](const std::vector<std::uint32_t>& piece) {
        const bool reaches = std::any_of(piece.begin(), piece.end(), [&](auto v) { return at_border(grid, v); });
        if (piece.size() > largest_size) {
          largest_size = piece.size();
          if (!largest.empty()) pockets.push_back(std::move(largest));
          largest = reaches ? std::vector<std::uint32_t>{} : piece;
        } else if (!reaches) {
          pockets.push_back(piece);
        }
      });
  for (const auto& pocket : pockets)
    for (const std::uint32_t v : pocket) solid[v] = 1.0f;
}

/// Which voxels say where the object is: measured and occupied, but for pieces of fewer than a few, which stray hits
/// leave; the largest piece counts in any case.
std::vector<std::uint8_t> trusted_voxels(const VoxelGrid& grid, std::span<const Voxel> voxels) {
  std::vector<std::uint8_t> trusted(voxels.size());
  std::vector<std::vector<std::uint32_t>> small;
  std::size_t largest = 0;
  for_each_piece(
      grid, Neighbours::all, [&](std::uint32_t v) { return voxels[v].measured && voxels[v].probability >= solid_from; },
      [&](const std::vector<std::uint32_t>& piece) {
        for (const std::uint32_t v : piece) trusted[v] = 1;
        largest = std::max(largest, piece.size());
        if (piece.size() < min_trusted) small.push_back(piece);
      });
  for (const auto& piece : small)
    if (piece.size() < largest)
      for (const std::uint32_t v : piece) trusted[v] = 0;
  return trusted;
}

/// Farther beyond the box of what is trusted than a quarter of its longest side nothing is solid, measured or not: the
/// shadow of the object there would reach to the region's border.
void clear_beyond(const VoxelGrid& grid, std::span<const std::uint8_t> trusted, std::vector<float>& solid) {
  Eigen::AlignedBox3i box;
  for (std::uint32_t v = 0; v < solid.size(); ++v)
    if (trusted[v]) box.extend(grid.cell(v));
  if (!box.isEmpty()) {
    const Eigen::Vector3i margin = Eigen::Vector3i::Constant(box.sizes().maxCoeff() / 4 + 1);
    box = {box.min() - margin, box.max() + margin};
  }
  for (std::uint32_t v = 0; v < solid.size(); ++v)
    if (solid[v] >= solid_from && !box.contains(grid.cell(v))) solid[v] = 0.0f;
}

/// Solid pieces that nothing trusted speaks for become free.
void drop_other_pieces(const VoxelGrid& grid, std::span<const std::uint8_t> trusted, std::vector<float>& solid) {
  const std::vector<float> before = solid;
  for_each_piece(
      grid, Neighbours::all, [&](std::uint32_t v) { return before[v] >= solid_from; },
      [&](const std::vector<std::uint32_t>& piece) {
        if (std::none_of(piece.begin(), piece.end(), [&](std::uint32_t v) { return trusted[v]; }))
          for (const std::uint32_t v : piece) solid[v] = 0.0f;
      });
}

/// Calls `visit(cells)` for each block of 2 x 2 x 2 solid voxels around a voxel.
template <class Visit>
void for_each_solid_block(const VoxelGrid& grid, std::span<const float> solid, std::uint32_t voxel, Visit visit) {
  const Eigen::Vector3i cell = grid.cell(voxel);
  for (int block = 0; block < 8; ++block) {
    const Eigen::Vector3i lowest = cell - Eigen::Vector3i(block & 1, block >> 1 & 1, block >> 2);
    std::array<std::uint32_t, 8> cells;
    bool all = true;
    for (int k = 0; k < 8 && all; ++k) {
      const Eigen::Vector3i other = lowest + Eigen::Vector3i(k & 1, k >> 1 & 1, k >> 2);
      all = grid.contains(other) && solid[cells[k] = grid.index(other)] >= solid_from;
    }
    if (all) visit(cells);
  }
}

/// Whether a voxel is in a single solid block, and so are the other seven of that.
bool in_lone_block(const VoxelGrid& grid, std::span<const float> solid, std::uint32_t voxel) {
  int blocks = 0, largest = 0;
  for_each_solid_block(grid, solid, voxel, [&](const std::array<std::uint32_t, 8>& cells) {
    ++blocks;
    for (const std::uint32_t v : cells) {
      int of_v = 0;
      for_each_solid_block(grid, solid, v, [&](const auto&) { ++of_v; });
      largest = std::max(largest, of_v);
    }
  });
  return blocks == 1 && largest == 1;
}

}  // namespace

std::vector<float> solid_voxels(const VoxelGrid& grid, std::span<const Voxel> voxels) {
  std::vector<float> solid(voxels.size());
  for (std::size_t v = 0; v < voxels.size(); ++v) solid[v] = voxels[v].measured ? voxels[v].probability : 1.0f;
  const std::vector<std::uint8_t> trusted = trusted_voxels(grid, voxels);
  clear_beyond(grid, trusted, solid);
  close_pockets(grid, solid);
  drop_other_pieces(grid, trusted, solid);
  return solid;
}

std::vector<Wall> wall_voxels(const VoxelGrid& grid, std::span<const float> solid) {
  std::vector<Wall> walls(solid.size(), Wall::none);
  for (std::uint32_t v = 0; v < solid.size(); ++v) {
    if (solid[v] < solid_from) continue;
    walls[v] = Wall::thin;
    for_each_solid_block(grid, solid, v, [&](const auto&) { walls[v] = Wall::thick; });
  }
  const auto beside = [&](std::uint32_t v, Wall wall) {
    bool found = false;
    for_each_neighbour(grid, v, Neighbours::all, [&](std::uint32_t n) { found |= walls[n] == wall; });
    return found;
  };
  std::vector<std::uint32_t> specks, steps;
  for_each_piece(
      grid, Neighbours::all, [&](std::uint32_t v) { return walls[v] == Wall::thin; },
      [&](const std::vector<std::uint32_t>& piece) {
        const auto on_thick = [&](std::uint32_t v) { return beside(v, Wall::thick); };
        if (piece.size() < fewest_thin && std::any_of(piece.begin(), piece.end(), on_thick))
          specks.insert(specks.end(), piece.begin(), piece.end());
      });
  for (const std::uint32_t v : specks) walls[v] = Wall::speck;
  for (std::uint32_t v = 0; v < solid.size(); ++v)
    if (walls[v] == Wall::thick && beside(v, Wall::thin) && in_lone_block(grid, solid, v)) steps.push_back(v);
  for (const std::uint32_t v : steps) walls[v] = Wall::step;
  return walls;
}

}  // namespace nextview
