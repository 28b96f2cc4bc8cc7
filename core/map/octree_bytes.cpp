#include "core/map/octree_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>

namespace nextview {
namespace {

constexpr int root_edge = 1 << 16;  // of OctoMap's trees [voxels]
constexpr int lowest_lattice = -(root_edge / 2);

/// What a cube of voxels comes to in the tree.
struct Node {
  float log_odds;  ///< of an inner node the largest below it
  bool is_leaf;
};
using Children = std::array<std::optional<Node>, 8>;

/// All eight the same: OctoMap makes one leaf of them.
bool can_be_pruned(const Children& children) {
  return std::ranges::all_of(children, [&](const std::optional<Node>& child) {
    return child && child->is_leaf && child->log_odds == children[0]->log_odds;
  });
}

/// Writes nodes before what is below them, and takes that back where it is pruned.
class Writer {
 public:
  Writer(const OccupancyMap& map, bool binary)
      : grid_(map.grid()),
        voxels_(map.voxels()),
        binary_(binary),
        head_(binary ? 2 : sizeof(float) + 1),
        lowest_(static_cast<float>(log_odds(map.model().clamp_min))),
        highest_(static_cast<float>(log_odds(map.model().clamp_max))),
        threshold_(static_cast<float>(log_odds(map.model().occupancy_threshold))) {}

  OctreeBytes write() && {
    cube(Eigen::Vector3i::Constant(lowest_lattice) - grid_.first, root_edge);
    return {std::move(bytes_), nodes_};
  }

 private:
  /// The node of the cube whose lowest voxel is at `first` in the grid; none if nothing in it is measured.
  std::optional<Node> cube(const Eigen::Vector3i& first, int edge) {
    if (edge == 1) return voxel(first);
    if (is_untouched(first, edge)) return std::nullopt;
    const std::size_t begin = bytes_.size(), nodes_before = nodes_++;
    bytes_.resize(begin + head_);
    Children children;
    for (int c = 0; c < 8; ++c)
      children[c] = cube(first + edge / 2 * Eigen::Vector3i(c & 1, c >> 1 & 1, c >> 2), edge / 2);
    const bool any = std::ranges::any_of(children, [](const auto& child) { return child.has_value(); });
    const bool pruned = can_be_pruned(children);
    if (!any || pruned) bytes_.resize(begin), nodes_ = nodes_before;
    if (pruned) return leaf(children[0]->log_odds);
    if (!any) return std::nullopt;
    return inner(children, begin);
  }

  std::optional<Node> voxel(const Eigen::Vector3i& cell) {
    if (!grid_.contains(cell)) return std::nullopt;
    const std::size_t place = voxels_.place(cell.x(), cell.y(), cell.z());
    const VoxelBricks::Brick& brick = *voxels_.bricks()[place / VoxelBricks::brick_voxels];
    const std::size_t i = place % VoxelBricks::brick_voxels;
    if (!brick.measured(i)) return std::nullopt;
    const float log_odds = std::min(std::max(brick.log_odds(i), lowest_), highest_);
    return leaf(!binary_ ? log_odds : log_odds >= threshold_ ? highest_ : lowest_);
  }

  /// Whether the cube lies beside the grid, or nothing was ever said of its bricks.
  bool is_untouched(const Eigen::Vector3i& first, int edge) const {
    const Eigen::Vector3i begin = first.cwiseMax(0),
                          last = (first.array() + (edge - 1)).matrix().cwiseMin(grid_.size - Eigen::Vector3i::Ones());
    if ((begin.array() > last.array()).any()) return true;
    if (edge < VoxelBricks::edge) return false;  // its voxels are soon looked at
    const Eigen::Vector3i from = begin / VoxelBricks::edge, to = last / VoxelBricks::edge,
                          bricks = voxels_.brick_edges();
    for (int z = from.z(); z <= to.z(); ++z)
      for (int y = from.y(); y <= to.y(); ++y)
        for (int x = from.x(); x <= to.x(); ++x)
          if (!voxels_.is_untouched((std::size_t(z) * bricks.y() + y) * bricks.x() + x)) return false;
    return true;
  }

  /// A .bt has a leaf in its parent's bytes.
  Node leaf(float log_odds) {
    ++nodes_;
    if (!binary_) {
      const std::size_t begin = bytes_.size();
      bytes_.resize(begin + head_);
      set_full_head(begin, log_odds, 0);
    }
    return {log_odds, true};
  }

  Node inner(const Children& children, std::size_t begin) {
    float largest = -std::numeric_limits<float>::max();
    unsigned there = 0, pairs = 0;
    for (unsigned c = 0; c < 8; ++c) {
      if (!children[c]) continue;
      largest = std::max(largest, children[c]->log_odds);
      there |= 1u << c;
      constexpr unsigned free = 1, occupied = 2, has_children = 3;
      pairs |= (!children[c]->is_leaf ? has_children : children[c]->log_odds >= threshold_ ? occupied : free) << 2 * c;
    }
    if (binary_)
      bytes_[begin] = static_cast<char>(pairs & 255), bytes_[begin + 1] = static_cast<char>(pairs >> 8);
    else
      set_full_head(begin, largest, there);
    return {largest, false};
  }

  void set_full_head(std::size_t begin, float log_odds, unsigned children) {
    std::memcpy(&bytes_[begin], &log_odds, sizeof log_odds);
    bytes_[begin + sizeof log_odds] = static_cast<char>(children);
  }

  const VoxelGrid& grid_;
  const VoxelBricks& voxels_;
  bool binary_;
  std::size_t head_;                    ///< of a node [bytes]
  float lowest_, highest_, threshold_;  ///< log-odds
  std::string bytes_;
  std::size_t nodes_ = 0;
};

}  // namespace

OctreeBytes octree_bytes(const OccupancyMap& map, bool binary) { return Writer(map, binary).write(); }

}  // namespace nextview
