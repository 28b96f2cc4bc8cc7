#include "core/map/octree_file.hpp"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

constexpr int key_offset = 32768;  // OctoMap's key of lattice coordinate 0
constexpr int tree_depth = 16;

octomap::OcTree to_octree(const OccupancyMap& map) {
  const InverseSensorModel& model = map.model();
  octomap::OcTree tree(map.grid().resolution);
  tree.setProbHit(model.hit);
  tree.setProbMiss(model.miss);
  tree.setClampingThresMin(model.clamp_min);
  tree.setClampingThresMax(model.clamp_max);
  tree.setOccupancyThres(model.occupancy_threshold);
  for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
    if (!map.voxels()[v].measured) continue;
    const Eigen::Vector3i lattice = map.grid().first + map.grid().cell(v);
    const octomap::OcTreeKey key(lattice.x() + key_offset, lattice.y() + key_offset, lattice.z() + key_offset);
    tree.setNodeValue(key, map.log_odds()[v], true);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

/// Walks the bytes of a tree without building it. OctoMap's own reader trusts them: a truncated file sends it into the woods.
class TreeBytes {
 public:
  TreeBytes(std::string_view bytes, bool binary) : bytes_(bytes), binary_(binary) {}
  bool well_formed() { return node(0) && at_ == bytes_.size(); }

 private:
  bool node(int depth) {
    if (depth > tree_depth) return false;
    return binary_ ? binary_node(depth) : full_node(depth);
  }
  /// .ot: log-odds, then a byte that tells which children follow.
  bool full_node(int depth) {
    if (bytes_.size() - at_ < 5) return false;
    float value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    const auto children = static_cast<unsigned char>(bytes_[at_ + 4]);
    at_ += 5;
    if (!std::isfinite(value)) return false;
    for (int c = 0; c < 8; ++c)
      if ((children >> c & 1) && !node(depth + 1)) return false;
    return true;
  }
  /// .bt: two bits a child, in two bytes; 3 says that the child's own two bytes follow.
  bool binary_node(int depth) {
    if (bytes_.size() - at_ < 2) return false;
    const unsigned children = static_cast<unsigned char>(bytes_[at_]) | static_cast<unsigned char>(bytes_[at_ + 1]) << 8;
    at_ += 2;
    for (int c = 0; c < 8; ++c)
      if ((children >> 2 * c & 3) == 3 && !node(depth + 1)) return false;
    return true;
  }

  std::string_view bytes_;
  bool binary_;
  std::size_t at_ = 0;
};

std::unique_ptr<octomap::OcTree> read_tree(const std::filesystem::path& file) {
  const auto fail = [&](std::string_view reason) {
    return std::runtime_error(fmt::format("{}: {}", file.string(), reason));
  };
  const std::string content = read_file(file);
  const bool binary = content.starts_with("# Octomap OcTree binary file");
  if (!binary && !content.starts_with("# Octomap OcTree file"))
    throw fail("is not an octree; expected OctoMap's .ot or .bt");
  const std::size_t data = content.find("\ndata\n");
  if (data == std::string::npos || content.substr(0, data).find("\nid OcTree") == std::string::npos)
    throw fail("its header is damaged, or it holds another kind of tree than OcTree");
  if (!TreeBytes(std::string_view(content).substr(data + 6), binary).well_formed())
    throw fail("is truncated or damaged");
  std::istringstream in(content);
  if (binary) {
    auto tree = std::make_unique<octomap::OcTree>(0.1);
    if (!tree->readBinary(in)) throw fail("cannot be read as OctoMap's .bt");
    return tree;
  }
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(in));
  auto* tree = dynamic_cast<octomap::OcTree*>(any.get());
  if (!tree) throw fail("cannot be read as OctoMap's .ot");
  any.release();
  return std::unique_ptr<octomap::OcTree>(tree);
}

/// Lattice cells that a leaf covers along one axis: its lowest, and how many.
std::pair<Eigen::Vector3i, int> extent(const octomap::OcTree::leaf_iterator& leaf) {
  const octomap::OcTreeKey key = leaf.getIndexKey();
  return {Eigen::Vector3i(key[0], key[1], key[2]).array() - key_offset, 1 << (tree_depth - leaf.getDepth())};
}

}  // namespace

void write_octree(const OccupancyMap& map, const std::filesystem::path& file) {
  const bool binary = file.extension() == ".bt";
  if (!binary && file.extension() != ".ot")
    throw std::runtime_error(fmt::format("{}: an octree's file must end in .ot or .bt", file.string()));
  octomap::OcTree tree = to_octree(map);
  AtomicFile out(file);
  if (binary)
    tree.writeBinary(out.stream());
  else
    tree.write(out.stream());
  out.commit();
}

OccupancyMap read_octree(const std::filesystem::path& file, const InverseSensorModel& model) {
  const auto tree = read_tree(file);
  constexpr int limit = std::numeric_limits<int>::max();
  Eigen::Vector3i lowest = Eigen::Vector3i::Constant(limit), highest = Eigen::Vector3i::Constant(-limit);
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    const auto [first, count] = extent(leaf);
    lowest = lowest.cwiseMin(first);
    highest = highest.cwiseMax(first + Eigen::Vector3i::Constant(count));
  }
  if (lowest.x() == limit) throw std::runtime_error(fmt::format("{}: the octree is empty", file.string()));
  VoxelGrid grid{tree->getResolution(), lowest, highest - lowest};
  constexpr std::size_t most = std::size_t{1} << 28;
  if (grid.voxel_count() > most)
    throw std::runtime_error(fmt::format("{}: the octree spans {} voxels; at most {} are held", file.string(),
                                         grid.voxel_count(), most));
  OccupancyMap map(grid, model);
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    const auto [first, count] = extent(leaf);
    for (int z = 0; z < count; ++z)
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
          map.set_log_odds(grid.index(first - grid.first + Eigen::Vector3i(x, y, z)), leaf->getLogOdds());
  }
  return map;
}

}  // namespace nextview
