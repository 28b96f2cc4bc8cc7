#include "core/evaluation/map_quality.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <stdexcept>

#include "core/evaluation/quality_sums.hpp"
#include "core/map/brick_memory.hpp"

namespace nextview {
namespace {

using Brick = VoxelBricks::Brick;

/// What is true of at most 64 voxels in a row, a bit each, the first one's the lowest; of those that are left out
/// nothing is.
struct RowTruth {
  std::uint64_t counted = 0, occupied = 0, in_band = 0, visited = 0;

  VoxelFacts of(std::size_t i) const {
    return unsigned(occupied >> i & 1) * is_occupied | unsigned(in_band >> i & 1) * is_in_band |
           unsigned(visited >> i & 1) * is_visited;
  }
  /// Those that are exactly this.
  std::uint64_t those(VoxelFacts facts) const {
    return counted & (facts & is_occupied ? occupied : ~occupied) & (facts & is_in_band ? in_band : ~in_band) &
           (facts & is_visited ? visited : ~visited);
  }
};

std::uint64_t lowest(std::size_t count) { return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0}; }

/// What the scores ask of the truth and the visits.
class Truth {
 public:
  /// `visited` may be null where no set needs it.
  Truth(const GroundTruth& truth, TruthConvention convention, std::span<const ScoredSet> sets, const BitMask* visited)
      : truth_(truth),
        occupied_(convention == TruthConvention::touch ? truth.touch : truth.centre),
        visited_(visited),
        only_visited_(std::ranges::all_of(sets, needs_visited)) {}

  RowTruth row(std::size_t first, std::size_t count) const {
    RowTruth row;
    if (visited_) row.visited = visited_->word(first) & lowest(count);
    row.counted = only_visited_ ? row.visited : lowest(count);
    if (row.counted == 0) return row;
    const std::uint64_t hidden = truth_.centre.word(first) & ~truth_.touch.word(first);
    row.counted &= ~hidden;
    row.occupied = occupied_.word(first) & row.counted;
    row.in_band = truth_.near_surface.word(first) & row.counted;
    return row;
  }

  static bool needs_visited(ScoredSet set) { return set == ScoredSet::visited || set == ScoredSet::visited_band; }

 private:
  const GroundTruth& truth_;
  const BitMask& occupied_;
  const BitMask* visited_;
  bool only_visited_;
};

/// `add(i, alike)` for all i below `parts`. Split and joined in the same places on any number of threads, so that the
/// sums round alike.
template <class Add>
std::vector<MapQuality> qualities(std::span<const ScoredSet> sets, std::size_t parts, std::size_t at_once, Add add) {
  const QualitySumsOfSets all = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, parts, at_once), QualitySumsOfSets(sets),
      [&](const auto& range, QualitySumsOfSets sums) {
        {
          AlikeVoxels alike(sums);
          for (std::size_t i = range.begin(); i != range.end(); ++i) add(i, alike);
        }
        return sums;
      },
      [](QualitySumsOfSets a, const QualitySumsOfSets& b) { return a += b; });
  std::vector<MapQuality> result;
  for (const ScoredSet set : sets) result.push_back(all.quality(set));
  return result;
}

/// Eight bricks in a row along x: their voxels' truth is read 64 a time.
class BrickStrips {
 public:
  BrickStrips(const VoxelBricks& voxels, const Truth& truth)
      : voxels_(voxels),
        truth_(truth),
        along_x_((std::size_t(voxels.brick_edges().x()) + strip_bricks - 1) / strip_bricks) {}

  std::size_t count() const { return along_x_ * voxels_.brick_edges().y() * voxels_.brick_edges().z(); }

  void add(std::size_t strip, AlikeVoxels& alike) const {
    const int first = static_cast<int>(strip % along_x_) * strip_bricks;
    const std::size_t bricks_before = strip / along_x_ * std::size_t(voxels_.brick_edges().x());
    Rows rows{};
    std::uint64_t any_counted = 0;
    const Eigen::Vector3i lowest_cell = voxels_.cell((bricks_before + first) * VoxelBricks::brick_voxels);
    const Eigen::Vector3i edges = voxels_.edges();
    for (int z = lowest_cell.z(); z < std::min(lowest_cell.z() + edge, edges.z()); ++z)
      for (int y = lowest_cell.y(); y < std::min(lowest_cell.y() + edge, edges.y()); ++y) {
        RowTruth& row = rows[(z & 7) * edge + (y & 7)];
        const std::size_t at = (std::size_t(z) * edges.y() + y) * edges.x() + lowest_cell.x();
        row = truth_.row(at, std::min<std::size_t>(64, edges.x() - lowest_cell.x()));
        any_counted |= row.counted;
      }
    if (any_counted == 0) return;
    BrickMemory<bool> is_uniform;
    for (int k = 0; k < std::min(strip_bricks, voxels_.brick_edges().x() - first); ++k) {
      if ((any_counted >> (k * edge) & 255) == 0) continue;
      const Brick& brick = *voxels_.bricks()[bricks_before + first + k];
      if (is_uniform.of(brick, [&] { return brick.is_uniform(); }))
        add_uniform(brick[0].probability, rows, k * edge, alike);
      else
        add_each(brick, rows, k * edge, alike);
    }
  }

 private:
  static constexpr int edge = VoxelBricks::edge, strip_bricks = 8;
  using Rows = std::array<RowTruth, std::size_t{edge} * edge>;

  static void add_uniform(float p, const Rows& rows, int shift, AlikeVoxels& alike) {
    std::uint64_t any_with[3] = {}, any_without[3] = {};  // occupied, in the band, visited
    for (const RowTruth& row : rows) {
      const std::uint64_t is[3] = {row.occupied, row.in_band, row.visited};
      for (int k = 0; k < 3; ++k) any_with[k] |= row.counted & is[k], any_without[k] |= row.counted & ~is[k];
    }
    const auto is_none = [&](VoxelFacts facts) {
      for (unsigned k = 0; k < 3; ++k)
        if (((facts >> k & 1 ? any_with : any_without)[k] >> shift & 255) == 0) return true;
      return false;
    };
    for (VoxelFacts facts = 0; facts < all_facts; ++facts) {
      if (is_none(facts)) continue;
      std::size_t count = 0;
      for (std::size_t r = 0; r < rows.size(); r += edge) {
        std::uint64_t layer = 0;  // counting bits takes longer than collecting them
        for (std::size_t y = 0; y < edge; ++y) layer = layer << edge | (rows[r + y].those(facts) >> shift & 255);
        count += std::size_t(std::popcount(layer));
      }
      if (count > 0) alike.add(p, facts, count);
    }
  }

  static void add_each(const Brick& brick, const Rows& rows, int shift, AlikeVoxels& alike) {
    BrickBeliefs believed(brick);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::uint64_t counted = rows[r].counted >> shift & 255;
      if (counted == 0) continue;
      const auto first = std::size_t(std::countr_zero(counted));
      const VoxelFacts facts = rows[r].of(shift + first);
      if ((rows[r].those(facts) >> shift & 255) == counted && same_log_odds(brick, r * edge)) {
        alike.add(believed.probability(r * edge + first), facts, std::size_t(std::popcount(counted)));
        continue;
      }
      for (std::uint64_t left = counted; left != 0; left &= left - 1) {
        const auto i = std::size_t(std::countr_zero(left));
        alike.add(believed.probability(r * edge + i), rows[r].of(shift + i), 1);
      }
    }
  }

  /// Whether the voxels of a row are all as likely, if they are measured.
  static bool same_log_odds(const Brick& brick, std::size_t first) {
    bool same = brick.follows_from_log_odds();
    for (std::size_t i = 1; i < edge; ++i)
      same &=
          (brick.numbers()[first + i] == brick.numbers()[first]) & (brick.measured(first + i) == brick.measured(first));
    return same;
  }

  const VoxelBricks& voxels_;
  const Truth& truth_;
  std::size_t along_x_;
};

void check_lengths(std::size_t probabilities, const GroundTruth& truth, std::span<const ScoredSet> sets,
                   std::size_t visited) {
  const std::size_t voxels = truth.grid.voxel_count();
  if (probabilities != voxels)
    throw std::invalid_argument(
        fmt::format("map quality: {} probabilities for {} voxels of truth", probabilities, voxels));
  for (const ScoredSet set : sets)
    if (Truth::needs_visited(set) && visited != voxels)
      throw std::invalid_argument(fmt::format(
          "map quality: the scored set '{}' needs a mask of {} visited voxels, not of {}", name(set), voxels, visited));
}

}  // namespace

std::vector<MapQuality> map_quality(std::span<const float> probabilities, const GroundTruth& truth,
                                    TruthConvention convention, std::span<const ScoredSet> sets,
                                    std::span<const std::uint8_t> visited) {
  check_lengths(probabilities.size(), truth, sets, visited.size());
  const BitMask mask(visited);
  const Truth is(truth, convention, sets, visited.empty() ? nullptr : &mask);
  const std::size_t voxels = probabilities.size();
  return qualities(sets, (voxels + 63) / 64, 512, [&](std::size_t part, AlikeVoxels& alike) {
    const std::size_t first = 64 * part;
    const RowTruth row = is.row(first, std::min<std::size_t>(64, voxels - first));
    for (std::uint64_t left = row.counted; left != 0; left &= left - 1) {
      const auto i = std::size_t(std::countr_zero(left));
      alike.add(probabilities[first + i], row.of(i), 1);
    }
  });
}

std::vector<MapQuality> map_quality(const VoxelBricks& voxels, const GroundTruth& truth, TruthConvention convention,
                                    std::span<const ScoredSet> sets, const BitMask& visited) {
  check_lengths(voxels.size(), truth, sets, visited.size());
  const Truth is(truth, convention, sets, visited.size() == voxels.size() ? &visited : nullptr);
  const BrickStrips strips(voxels, is);
  return qualities(sets, strips.count(), 16, [&](std::size_t strip, AlikeVoxels& alike) { strips.add(strip, alike); });
}

MapQuality map_quality(std::span<const float> probabilities, const GroundTruth& truth, TruthConvention convention,
                       ScoredSet set, std::span<const std::uint8_t> visited) {
  return map_quality(probabilities, truth, convention, std::span(&set, 1), visited).front();
}

}  // namespace nextview
