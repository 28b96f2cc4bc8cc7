#include "core/surface/solid_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tests/unit/surface/made_maps.hpp"

namespace nextview {
namespace {

using made_maps::free_space;
using made_maps::grid_of;
using made_maps::measured;

/// Pieces by spreading the largest number of a voxel, in place and forth, until nothing changes; -1 where nothing
/// belongs. `steps`: how many of the coordinates may differ between neighbours.
template <class Belongs>
std::vector<int> pieces(const VoxelGrid& grid, int steps, Belongs belongs) {
  std::vector<int> piece(grid.voxel_count(), -1);
  for (std::size_t v = 0; v < piece.size(); ++v)
    if (belongs(v)) piece[v] = int(v);
  std::vector<std::pair<std::size_t, std::size_t>> beside;
  for (std::uint32_t a = 0; a < piece.size(); ++a)
    for (std::uint32_t b = 0; b < piece.size(); ++b) {
      if (piece[a] < 0 || piece[b] < 0) continue;
      const Eigen::Vector3i apart = (grid.cell(a) - grid.cell(b)).cwiseAbs();
      if (apart.maxCoeff() <= 1 && apart.sum() <= steps) beside.emplace_back(a, b);
    }
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : beside) {
      changed |= piece[a] < piece[b];
      piece[a] = std::max(piece[a], piece[b]);
    }
  }
  return piece;
}

bool at_border(const VoxelGrid& grid, std::uint32_t v) {
  const Eigen::Vector3i c = grid.cell(v), d = grid.size - Eigen::Vector3i::Ones() - c;
  return c.minCoeff() == 0 || d.minCoeff() == 0;
}

/// Measured and occupied, in a piece (over corners too) of at least four or of the largest there is.
std::vector<std::uint8_t> trusted_twin(const VoxelGrid& grid, const std::vector<Voxel>& voxels) {
  const auto piece =
      pieces(grid, 3, [&](std::size_t v) { return voxels[v].measured && voxels[v].probability >= 0.5f; });
  const auto size = [&](int number) { return std::count(piece.begin(), piece.end(), number); };
  std::ptrdiff_t largest = 0;
  for (const int number : piece)
    if (number >= 0) largest = std::max(largest, size(number));
  std::vector<std::uint8_t> trusted;
  for (const int number : piece) trusted.push_back(number >= 0 && (size(number) >= 4 || size(number) == largest));
  return trusted;
}

/// What is not measured is solid; beyond the box of what is trusted nothing is; free pockets (over faces) that do not
/// reach the border close, but for the largest piece of free space; solid pieces (over corners too) without a trusted
/// voxel go. Nothing if it is not said which pocket is the largest.
std::optional<std::vector<float>> solid_twin(const VoxelGrid& grid, const std::vector<Voxel>& voxels) {
  std::vector<float> solid;
  for (const Voxel& v : voxels) solid.push_back(v.measured ? v.probability : 1.0f);
  const std::vector<std::uint8_t> trusted = trusted_twin(grid, voxels);
  int longest = 0;
  for (std::uint32_t a = 0; a < solid.size(); ++a)
    for (std::uint32_t b = 0; b < solid.size(); ++b)
      if (trusted[a] && trusted[b]) longest = std::max(longest, (grid.cell(a) - grid.cell(b)).maxCoeff());
  const int margin = longest / 4 + 1;
  for (std::uint32_t v = 0; v < solid.size(); ++v) {
    bool within = true;  // of the box of the trusted ones and a quarter of its longest side, one more for the rest
    for (int axis = 0; axis < 3; ++axis) {
      bool below = false, above = false;
      for (std::uint32_t t = 0; t < solid.size(); ++t) {
        below |= trusted[t] && grid.cell(t)[axis] - margin <= grid.cell(v)[axis];
        above |= trusted[t] && grid.cell(t)[axis] + margin >= grid.cell(v)[axis];
      }
      within &= below && above;
    }
    if (!within && solid[v] >= 0.5f) solid[v] = 0.0f;
  }
  const std::vector<int> open = pieces(grid, 1, [&](std::size_t v) { return solid[v] < 0.5f; });
  std::map<int, std::size_t> sizes;
  std::set<int> reaching;
  for (std::uint32_t v = 0; v < open.size(); ++v)
    if (open[v] >= 0) {
      ++sizes[open[v]];
      if (at_border(grid, v)) reaching.insert(open[v]);
    }
  std::size_t largest = 0;
  for (const auto& [piece, size] : sizes) largest = std::max(largest, size);
  std::set<int> with_largest;
  for (const auto& [piece, size] : sizes)
    if (size == largest) with_largest.insert(piece);
  if (with_largest.size() > 1) return {};
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (open[v] < 0 || reaching.contains(open[v]) || with_largest.contains(open[v])) continue;
    solid[v] = 1.0f;
  }
  const std::vector<int> filled = pieces(grid, 3, [&](std::size_t v) { return solid[v] >= 0.5f; });
  std::set<int> spoken_for;
  for (std::size_t v = 0; v < filled.size(); ++v)
    if (filled[v] >= 0 && trusted[v]) spoken_for.insert(filled[v]);
  for (std::size_t v = 0; v < filled.size(); ++v)
    if (filled[v] >= 0 && !spoken_for.contains(filled[v])) solid[v] = 0.0f;
  return solid;
}

/// Of each voxel of the map how solid it is; what is beyond the part is free.
std::vector<float> solid_voxels(const VoxelGrid& grid, const std::vector<Voxel>& voxels) {
  const std::optional<SolidPart> part = solid_part(grid, VoxelBricks(grid.size, voxels), DecidedVoxels());
  std::vector<float> solid;
  for (std::uint32_t v = 0; v < voxels.size(); ++v) {
    const Eigen::Vector3i cell = grid.cell(v) - (part ? part->offset : Eigen::Vector3i::Zero().eval());
    const float p = voxels[v].measured ? voxels[v].probability : 1.0f;
    const bool inside = part && part->grid.contains(cell);
    if (inside) {
      EXPECT_EQ(part->measured[part->grid.index(cell)], voxels[v].measured);
    }
    solid.push_back(inside ? part->solid[part->grid.index(cell)] : p < solid_from ? p : 0.0f);
  }
  return solid;
}

TEST(SolidVoxels, RandomMapsAgreeWithThePlainTwin) {
  std::mt19937 random(5);
  std::size_t closed = 0, dropped = 0, compared = 0;
  for (int n = 0; n < 400; ++n) {
    const VoxelGrid grid = grid_of({3 + n % 4, 3 + n / 4 % 4, 3 + n / 16 % 4});
    const auto voxels = made_maps::random_voxels(random, grid, 0.15 * (n % 3), 0.02 + 0.18 * (n % 5));
    const auto solid = solid_voxels(grid, voxels);
    const auto twin = solid_twin(grid, voxels);
    if (!twin) continue;
    ++compared;
    ASSERT_EQ(solid, *twin) << "map " << n;
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      const float p = voxels[v].measured ? voxels[v].probability : 1.0f;
      closed += p < 0.5f && solid[v] == 1.0f;
      dropped += p >= 0.5f && solid[v] == 0.0f;
    }
  }
  EXPECT_GT(compared, 300u);
  EXPECT_GT(closed, 100u);
  EXPECT_GT(dropped, 100u);
}

TEST(SolidVoxels, AClosedPocketBecomesSolidAndOneThatReachesTheBorderStays) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  std::vector<Voxel> voxels = free_space(grid);
  for (int z = 2; z < 7; ++z)
    for (int y = 2; y < 7; ++y)
      for (int x = 2; x < 7; ++x) voxels[grid.index({x, y, z})] = measured(0.9f);
  voxels[grid.index({4, 4, 4})] = measured(0.2f);
  EXPECT_EQ(solid_voxels(grid, voxels)[grid.index({4, 4, 4})], 1.0f);
  for (int x = 5; x < 7; ++x) voxels[grid.index({x, 4, 4})] = measured(0.2f);
  EXPECT_EQ(solid_voxels(grid, voxels)[grid.index({4, 4, 4})], 0.2f);
  EXPECT_EQ(solid_voxels(grid, voxels)[grid.index({3, 4, 4})], 0.9f);
}

TEST(SolidVoxels, FreeSpaceAroundACameraWithinTheRegionStays) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  std::vector<Voxel> voxels(grid.voxel_count());
  for (int x = 2; x < 6; ++x) voxels[grid.index({x, 4, 4})] = measured(0.1f);
  voxels[grid.index({6, 4, 4})] = measured(0.9f);
  EXPECT_EQ(solid_voxels(grid, voxels)[grid.index({4, 4, 4})], 0.1f);
}

/// The header's words, voxel by voxel.
std::vector<std::uint8_t> thin_of(const VoxelGrid& grid, const std::vector<float>& solid) {
  std::vector<std::uint8_t> thin;
  for (const Wall wall : wall_voxels(grid, solid)) thin.push_back(wall == Wall::thin || wall == Wall::step);
  return thin;
}

std::vector<std::uint8_t> thin_twin(const VoxelGrid& grid, const std::vector<float>& solid) {
  std::vector<std::uint8_t> thin(solid.size());
  std::vector<int> thick(solid.size());  // solid blocks around it
  const auto is_solid = [&](const Eigen::Vector3i& c) { return grid.contains(c) && solid[grid.index(c)] >= 0.5f; };
  for (int z = 0; z <= grid.size.z(); ++z)
    for (int y = 0; y <= grid.size.y(); ++y)
      for (int x = 0; x <= grid.size.x(); ++x) {  // corners
        std::vector<Eigen::Vector3i> around;
        for (int k = 0; k < 8; ++k) around.emplace_back(x - (k & 1), y - (k >> 1 & 1), z - (k >> 2));
        if (!std::all_of(around.begin(), around.end(), is_solid)) continue;
        for (const auto& c : around) ++thick[grid.index(c)];
      }
  for (std::size_t v = 0; v < thin.size(); ++v) thin[v] = solid[v] >= 0.5f && !thick[v];
  const std::vector<int> piece = pieces(grid, 3, [&](std::size_t v) { return thin[v] != 0; });
  const std::vector<std::uint8_t> all = thin;
  for (std::uint32_t v = 0; v < thin.size(); ++v) {
    bool on_thick = false;
    for (std::uint32_t a = 0; a < thin.size(); ++a)
      for (std::uint32_t b = 0; b < thin.size() && piece[v] >= 0 && piece[a] == piece[v]; ++b)
        on_thick |= thick[b] && (grid.cell(a) - grid.cell(b)).cwiseAbs().maxCoeff() <= 1;
    if (all[v] && on_thick && std::count(piece.begin(), piece.end(), piece[v]) < 4) thin[v] = 0;
  }
  std::vector<std::uint8_t> lone(solid.size());  // in a block whose voxels are in no other
  for (int z = 1; z < grid.size.z(); ++z)
    for (int y = 1; y < grid.size.y(); ++y)
      for (int x = 1; x < grid.size.x(); ++x) {
        int most = 0;
        bool whole = true;
        const auto each = [&](auto visit) {
          for (int k = 0; k < 8; ++k) visit(Eigen::Vector3i(x - (k & 1), y - (k >> 1 & 1), z - (k >> 2)));
        };
        each([&](const Eigen::Vector3i& c) {
          whole &= is_solid(c);
          most = std::max(most, thick[grid.index(c)]);
        });
        if (whole && most == 1) each([&](const Eigen::Vector3i& c) { lone[grid.index(c)] = 1; });
      }
  const std::vector<std::uint8_t> without_steps = thin;
  for (std::uint32_t a = 0; a < thin.size(); ++a)
    for (std::uint32_t b = 0; b < thin.size(); ++b)
      if (without_steps[b] && lone[a]) thin[a] |= (grid.cell(a) - grid.cell(b)).cwiseAbs().maxCoeff() <= 1;
  return thin;
}

TEST(ThinVoxels, RandomMapsAgreeWithThePlainTwin) {
  std::mt19937 random(6);
  std::size_t thin_ones = 0;
  for (int n = 0; n < 300; ++n) {
    const VoxelGrid grid = grid_of({3 + n % 3, 3 + n / 3 % 3, 3 + n / 9 % 4});
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    std::vector<float> solid(grid.voxel_count());
    for (float& s : solid) s = (uniform(random) < 0.3 + 0.15 * (n % 5) ? 0.5f : 0.0f) + 0.49f * uniform(random);
    const auto thin = thin_of(grid, solid);
    const auto twin = thin_twin(grid, solid);
    ASSERT_EQ(thin, twin) << "map " << n;
    thin_ones += std::count(twin.begin(), twin.end(), 1);
  }
  EXPECT_GT(thin_ones, 500u);
}

TEST(ThinVoxels, AWallOfOneVoxelIsThinAndOneOfTwoIsNot) {
  const VoxelGrid grid = grid_of({8, 8, 8});
  std::vector<float> solid(grid.voxel_count());
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) solid[grid.index({x, y, 3})] = 0.5f;
  const auto one = thin_of(grid, solid);
  EXPECT_EQ(std::count(one.begin(), one.end(), 1), 64);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) solid[grid.index({x, y, 4})] = 1.0f;
  const auto two = thin_of(grid, solid);
  EXPECT_EQ(std::count(two.begin(), two.end(), 1), 0);
}

}  // namespace
}  // namespace nextview
