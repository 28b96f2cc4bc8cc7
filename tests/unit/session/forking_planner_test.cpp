// A planner that looks ahead in a tree of ten thousand forks, as large as a map gets.
#include <gtest/gtest.h>

#include <optional>

#include "core/planner/knowledge.hpp"

namespace nextview {
namespace {

/// What a look-ahead believes a view would measure: a patch of the object's side that faces the camera.
Scan expected_scan(const View& view, std::uint32_t number) {
  Scan scan;
  scan.origin = view.T_world_camera.translation();
  scan.max_range = 1.5;
  const Vector3 towards = -scan.origin.normalized(), across = towards.unitOrthogonal();
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 0.5 * i + 0.01 * number;
    const Vector3 offset = 0.2 * std::sin(angle) * across + 0.2 * std::cos(angle) * towards.cross(across);
    scan.hits.push_back((offset - 0.1 * towards).cast<float>());
  }
  return scan;
}

View view_number(std::uint32_t number) {
  const double a = 2.4 * number, z = 0.8 - 1.6 * ((number * 37) % 101) / 100.0;
  return {look_at({0.9 * std::cos(a), 0.9 * std::sin(a), z}, Vector3::Zero())};
}

struct Node {
  std::optional<std::size_t> parent;
  Scan scan;
  std::optional<Knowledge> known;  ///< dropped where memory is short; made again from the parent's
};

/// A tree of forks that keeps at most so many maps.
class Tree {
 public:
  Tree(const Knowledge& root, std::size_t max_maps) : max_maps_(max_maps) { nodes_.push_back({{}, {}, root}); }

  std::size_t add(std::size_t parent, Scan scan) {
    Knowledge known = knowledge(parent);
    fuse(known, scan, fusion_);
    nodes_.push_back({parent, std::move(scan), std::move(known)});
    keep(nodes_.size() - 1);
    return nodes_.size() - 1;
  }
  Knowledge knowledge(std::size_t node) {
    if (nodes_[node].known) return *nodes_[node].known;
    Knowledge known = knowledge(*nodes_[node].parent);
    fuse(known, nodes_[node].scan, fusion_);
    nodes_[node].known = known;
    keep(node);
    return known;
  }
  /// What all maps take that the root does not share [bytes].
  std::size_t bytes_over_root() const {
    std::size_t bytes = 0;
    for (const Node& node : nodes_) {
      bytes += sizeof node + node.scan.hits.size() * sizeof node.scan.hits[0];
      if (node.parent && node.known) bytes += node.known->map.voxels().bytes_beside(nodes_[0].known->map.voxels());
    }
    return bytes;
  }
  std::size_t size() const { return nodes_.size(); }

 private:
  void keep(std::size_t node) {
    kept_.push_back(node);
    if (kept_.size() <= max_maps_) return;
    nodes_[kept_.front()].known.reset();
    kept_.erase(kept_.begin());
  }
  static constexpr FusionConfig fusion_{Insertion::direct};
  std::size_t max_maps_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> kept_;  ///< the oldest first
};

TEST(ForkingPlanner, TenThousandForksTakeLittleMemory) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  ASSERT_EQ(grid.voxel_count(), 128u * 128u * 128u);
  Knowledge root{OccupancyMap(grid)};
  for (std::uint32_t k = 0; k < 5; ++k) fuse(root, expected_scan(view_number(k), k), {Insertion::direct});
  Tree tree(root, 200);
  constexpr std::uint32_t branching = 10;
  std::size_t most = 0;
  for (std::uint32_t k = 1; k <= 10'000; ++k) {
    tree.add((k - 1) / branching, expected_scan(view_number(k), k));
    if (k % 500 == 0) most = std::max(most, tree.bytes_over_root());
  }
  EXPECT_EQ(tree.size(), 10'001u);
  EXPECT_LE(most, std::size_t{1} << 30);
  RecordProperty("max_bytes_over_root", std::to_string(most));
  // A leaf whose maps were dropped, and its way back, is made again as it was.
  Knowledge expected = root;
  std::vector<std::uint32_t> way;
  for (std::uint32_t k = 4321; k > 0; k = (k - 1) / branching) way.insert(way.begin(), k);
  for (const std::uint32_t k : way) fuse(expected, expected_scan(view_number(k), k), {Insertion::direct});
  EXPECT_TRUE(std::ranges::equal(tree.knowledge(4321).map.voxels(), expected.map.voxels(), {}, &Voxel::log_odds,
                                 &Voxel::log_odds));
}

}  // namespace
}  // namespace nextview
