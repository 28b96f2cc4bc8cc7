#include "core/surface/solid_voxels.hpp"

#include <tbb/parallel_for.h>

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

/// Calls `visit(piece)` with the voxels of each connected piece of those that are set in `left`.
template <class Visit>
void for_each_piece(const VoxelGrid& grid, Neighbours neighbours, BitMask left, Visit visit) {
  std::vector<std::uint32_t> piece;
  left.for_each([&](std::size_t start) {
    if (!left[start]) return;  // it was in an earlier piece
    left.set(start, false);
    piece.assign(1, static_cast<std::uint32_t>(start));
    for (std::size_t next = 0; next < piece.size(); ++next)
      for_each_neighbour(grid, piece[next], neighbours, [&](std::uint32_t v) {
        if (!left[v]) return;
        left.set(v, false);
        piece.push_back(v);
      });
    visit(piece);
  });
}

template <class Belongs>
BitMask mask_of(std::size_t count, Belongs belongs) {
  BitMask mask(count);
  for (std::size_t v = 0; v < count; ++v)
    if (belongs(v)) mask.set(v);
  return mask;
}

bool at_border(const VoxelGrid& grid, std::uint32_t voxel) {
  const Eigen::Vector3i cell = grid.cell(voxel);
  return (cell.array() == 0).any() || (cell.array() == grid.size.array() - 1).any();
}

/// Free pockets that do not reach the region's border become solid. The largest stays in any case: a region may end
/// where nothing was measured. What is free beyond the part, `beyond` voxels, is one piece with what is free at the
/// part's border within the map, and reaches the region's.
void close_pockets(SolidPart& part, std::size_t beyond, const Eigen::AlignedBox3i& box) {
  std::vector<std::vector<std::uint32_t>> pockets;
  std::vector<std::uint32_t> largest;
  std::size_t largest_size = 0;
  const auto is_outside = [&](std::uint32_t v) { return !box.contains(part.grid.cell(v)); };
  for_each_piece(part.grid, Neighbours::faces,
                 mask_of(part.solid.size(), [&](auto v) { return part.solid[v] < solid_from; }),
                 [&](const std::vector<std::uint32_t>& piece) {
                   const bool reaches = std::ranges::any_of(piece, [&](auto v) { return at_border(part.grid, v); });
                   const bool goes_on = beyond > 0 && reaches && std::ranges::any_of(piece, is_outside);
                   const std::size_t size = piece.size() + (goes_on ? beyond : 0);
                   if (size > largest_size) {
                     largest_size = size;
                     if (!largest.empty()) pockets.push_back(std::move(largest));
                     largest = reaches ? std::vector<std::uint32_t>{} : piece;
                   } else if (!reaches) {
                     pockets.push_back(piece);
                   }
                 });
  for (const auto& pocket : pockets)
    for (const std::uint32_t v : pocket) part.solid[v] = 1.0f;
}

/// Of a map, the voxels that are measured and occupied.
BitMask occupied_voxels(const VoxelGrid& grid, const VoxelBricks& voxels, const DecidedVoxels& decided) {
  const auto is_occupied = [&](const Voxel& voxel) { return decided(voxel) && voxel.probability >= solid_from; };
  BitMask occupied(grid.voxel_count());
  for (std::size_t b = 0; b < voxels.brick_count(); ++b) {
    const VoxelBricks::Brick& brick = *voxels.bricks()[b];
    if (brick.is_uniform() && !is_occupied(brick[0])) continue;
    for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i)
      if (is_occupied(brick[i])) occupied.set(grid.index(voxels.cell(b * VoxelBricks::brick_voxels + i)));
  }
  return occupied;
}

/// Which of the occupied voxels say where the object is: all but pieces of fewer than a few, which stray hits leave;
/// the largest piece counts in any case.
BitMask trusted_voxels(const VoxelGrid& grid, const BitMask& occupied) {
  BitMask trusted = occupied;
  std::vector<std::vector<std::uint32_t>> small;
  std::size_t largest = 0;
  for_each_piece(grid, Neighbours::all, occupied, [&](const std::vector<std::uint32_t>& piece) {
    largest = std::max(largest, piece.size());
    if (piece.size() < min_trusted) small.push_back(piece);
  });
  for (const auto& piece : small)
    if (piece.size() < largest)
      for (const std::uint32_t v : piece) trusted.set(v, false);
  return trusted;
}

/// Farther beyond the box of what is trusted than a quarter of its longest side nothing is solid, measured or not: the
/// shadow of the object there would reach to the region's border.
Eigen::AlignedBox3i box_around(const VoxelGrid& grid, const BitMask& trusted) {
  Eigen::AlignedBox3i box;
  trusted.for_each([&](std::size_t v) { box.extend(grid.cell(static_cast<std::uint32_t>(v))); });
  const Eigen::Vector3i margin = Eigen::Vector3i::Constant(box.sizes().maxCoeff() / 4 + 1);
  return {box.min() - margin, box.max() + margin};
}

Eigen::AlignedBox3i whole(const VoxelGrid& grid) {
  return {Eigen::Vector3i::Zero(), grid.size - Eigen::Vector3i::Ones()};
}

/// The box with two voxels more on each side. All of the grid if the box reaches from one of its sides to the other:
/// what is free beyond might be in two pieces.
Eigen::AlignedBox3i part_around(const VoxelGrid& grid, const Eigen::AlignedBox3i& box) {
  const Eigen::AlignedBox3i all = whole(grid);
  if (((box.min().array() <= 0) && (box.max().array() >= all.max().array())).any()) return all;
  const Eigen::Vector3i more = Eigen::Vector3i::Constant(2);
  return all.intersection(Eigen::AlignedBox3i(box.min() - more, box.max() + more));
}

/// Reads the part's voxels: those beyond `box` (counted in the part) are not solid.
void read_part(const VoxelBricks& voxels, const DecidedVoxels& decided, const Eigen::AlignedBox3i& box,
               SolidPart& part) {
  part.solid.resize(part.grid.voxel_count());
  part.measured = BitMask(part.solid.size());
  for (std::uint32_t v = 0; v < part.solid.size(); ++v) {
    const Eigen::Vector3i here = part.grid.cell(v), cell = here + part.offset;
    const Voxel voxel = voxels.at(cell.x(), cell.y(), cell.z());
    const bool measured = decided(voxel);
    part.measured.set(v, measured);
    part.solid[v] = measured ? voxel.probability : 1.0f;
    if (part.solid[v] >= solid_from && !box.contains(here)) part.solid[v] = 0.0f;
  }
}

/// Solid pieces that nothing trusted speaks for become free. `trusted` is of the map.
void drop_other_pieces(const VoxelGrid& map, const BitMask& trusted, SolidPart& part) {
  const auto is_trusted = [&](std::uint32_t v) { return trusted[map.index(part.grid.cell(v) + part.offset)]; };
  for_each_piece(part.grid, Neighbours::all,
                 mask_of(part.solid.size(), [&](auto v) { return part.solid[v] >= solid_from; }),
                 [&](const std::vector<std::uint32_t>& piece) {
                   if (std::ranges::none_of(piece, is_trusted))
                     for (const std::uint32_t v : piece) part.solid[v] = 0.0f;
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

DecidedVoxels::DecidedVoxels(std::optional<double> prior) {
  if (!prior) return;
  constexpr double factor = 2.0;
  const auto with_odds = [](double odds) { return odds / (1.0 + odds); };
  const double odds = *prior / (1.0 - *prior);
  low_ = with_odds(odds / factor), high_ = with_odds(odds * factor);
}

std::optional<SolidPart> solid_part(const VoxelGrid& grid, const VoxelBricks& voxels, const DecidedVoxels& decided) {
  const BitMask occupied = occupied_voxels(grid, voxels, decided);
  if (occupied == BitMask(occupied.size())) return std::nullopt;
  const BitMask trusted = trusted_voxels(grid, occupied);
  const Eigen::AlignedBox3i box = box_around(grid, trusted);
  const Eigen::AlignedBox3i place = part_around(grid, box);
  SolidPart part;
  part.offset = place.min();
  part.grid = {grid.resolution, grid.first + part.offset, place.sizes() + Eigen::Vector3i::Ones()};
  const Eigen::AlignedBox3i in_part(box.min() - part.offset, box.max() - part.offset);
  read_part(voxels, decided, in_part, part);
  close_pockets(part, grid.voxel_count() - part.grid.voxel_count(), in_part);
  drop_other_pieces(grid, trusted, part);
  return part;
}

std::vector<Wall> wall_voxels(const VoxelGrid& grid, std::span<const float> solid) {
  std::vector<Wall> walls(solid.size(), Wall::none);
  tbb::parallel_for(std::uint32_t{0}, std::uint32_t(solid.size()), [&](std::uint32_t v) {
    if (solid[v] < solid_from) return;
    walls[v] = Wall::thin;
    for_each_solid_block(grid, solid, v, [&](const auto&) { walls[v] = Wall::thick; });
  });
  const auto beside = [&](std::uint32_t v, Wall wall) {
    bool found = false;
    for_each_neighbour(grid, v, Neighbours::all, [&](std::uint32_t n) { found |= walls[n] == wall; });
    return found;
  };
  std::vector<std::uint32_t> specks;
  for_each_piece(grid, Neighbours::all, mask_of(walls.size(), [&](auto v) { return walls[v] == Wall::thin; }),
                 [&](const std::vector<std::uint32_t>& piece) {
                   const auto on_thick = [&](std::uint32_t v) { return beside(v, Wall::thick); };
                   if (piece.size() < fewest_thin && std::any_of(piece.begin(), piece.end(), on_thick))
                     specks.insert(specks.end(), piece.begin(), piece.end());
                 });
  for (const std::uint32_t v : specks) walls[v] = Wall::speck;
  std::vector<std::uint8_t> is_step(walls.size());
  tbb::parallel_for(std::uint32_t{0}, std::uint32_t(walls.size()), [&](std::uint32_t v) {
    is_step[v] = walls[v] == Wall::thick && beside(v, Wall::thin) && in_lone_block(grid, solid, v);
  });
  for (std::size_t v = 0; v < walls.size(); ++v)
    if (is_step[v]) walls[v] = Wall::step;
  return walls;
}

}  // namespace nextview
