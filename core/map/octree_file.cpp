#include "core/map/octree_file.hpp"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/map/octree_bytes.hpp"

namespace nextview {
namespace {

constexpr int key_offset = 32768;  // OctoMap's key of lattice coordinate 0
constexpr int tree_depth = 16;

/// As OctoMap writes it.
void write_head(std::ostream& out, std::size_t nodes, double resolution, bool binary) {
  out << (binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file")
      << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\nid OcTree\nsize " << nodes
      << "\nres " << resolution << "\ndata\n";
}

/// Walks the bytes of a tree without building it. OctoMap's own reader trusts them: a truncated file sends it into the
/// woods.
class TreeBytes {
 public:
  TreeBytes(std::string_view bytes, bool binary, bool coloured)
      : bytes_(bytes), binary_(binary), colour_size_(coloured && !binary ? 3 : 0) {}
  bool well_formed() { return node(0) && at_ == bytes_.size(); }
  /// The bytes of the same tree without colours. @pre well_formed()
  std::string without_colours() { return colour_size_ == 0 ? std::string(bytes_) : std::move(plain_); }

 private:
  bool node(int depth) {
    if (depth > tree_depth) return false;
    return binary_ ? binary_node(depth) : full_node(depth);
  }
  /// .ot: log-odds, a coloured tree's red, green and blue, then a byte that tells which children follow.
  bool full_node(int depth) {
    if (bytes_.size() - at_ < 5 + colour_size_) return false;
    float value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    const auto children = static_cast<unsigned char>(bytes_[at_ + 4 + colour_size_]);
    if (colour_size_ > 0) plain_.append(bytes_.substr(at_, 4)).push_back(bytes_[at_ + 4 + colour_size_]);
    at_ += 5 + colour_size_;
    if (!std::isfinite(value)) return false;
    for (int c = 0; c < 8; ++c)
      if ((children >> c & 1) && !node(depth + 1)) return false;
    return true;
  }
  /// .bt: two bits a child, in two bytes; 3 says that the child's own two bytes follow.
  bool binary_node(int depth) {
    if (depth == tree_depth || bytes_.size() - at_ < 2) return false;
    const unsigned children = static_cast<unsigned char>(bytes_[at_]) | static_cast<unsigned char>(bytes_[at_ + 1])
                                                                            << 8;
    at_ += 2;
    if (children == 0 && depth > 0) return false;
    for (int c = 0; c < 8; ++c)
      if ((children >> 2 * c & 3) == 3 && !node(depth + 1)) return false;
    return true;
  }

  std::string_view bytes_;
  bool binary_;
  std::size_t colour_size_;  ///< of a node [bytes]
  std::size_t at_ = 0;
  std::string plain_;
};

/// The head of a tree's file, and the bytes that follow it.
struct Head {
  std::string_view id, size, resolution, data;
};

/// OctoMap's own reader takes the word `data` anywhere for the end of the head; here it stands alone on its line.
std::optional<Head> parse_head(std::string_view content) {
  Head head;
  for (std::size_t begin = 0, end; (end = content.find('\n', begin)) != content.npos; begin = end + 1) {
    const std::string_view line = content.substr(begin, end - begin);
    head.data = content.substr(end + 1);
    if (line == "data") return head;
    if (line.starts_with("id ")) head.id = line.substr(3);
    if (line.starts_with("size ")) head.size = line.substr(5);
    if (line.starts_with("res ")) head.resolution = line.substr(4);
  }
  return std::nullopt;
}

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::unique_ptr<octomap::OcTree> read_tree(const std::filesystem::path& file, const InverseSensorModel& model) {
  const auto fail = [&](std::string_view reason) {
    return std::runtime_error(fmt::format("{}: {}", file.string(), reason));
  };
  const std::string content = read_file(file);
  const bool binary = content.starts_with("# Octomap OcTree binary file");
  if (!binary && !content.starts_with("# Octomap OcTree file"))
    throw fail("is not an octree; expected OctoMap's .ot or .bt");
  const std::optional<Head> head = parse_head(content);
  const bool coloured = head && head->id == "ColorOcTree";
  if (!head || (head->id != "OcTree" && !coloured))
    throw fail("its header is damaged, or it holds another kind of tree than OcTree or ColorOcTree");
  const auto resolution = parse<double>(head->resolution);
  if (!resolution || !(*resolution >= 1e-6 && *resolution <= 1e3))
    throw fail(fmt::format("its voxel edge, `res {}`, is not between 1e-6 and 1000 m", head->resolution));
  TreeBytes bytes(head->data, binary, coloured);
  if (!bytes.well_formed()) throw fail("is truncated or damaged");
  auto tree = std::make_unique<octomap::OcTree>(*resolution);
  tree->setClampingThresMin(model.clamp_min);  // what .bt has for free and for occupied
  tree->setClampingThresMax(model.clamp_max);
  std::istringstream data(bytes.without_colours());
  binary ? tree->readBinaryData(data) : tree->readData(data);
  if (parse<std::size_t>(head->size) != tree->size())
    throw fail(fmt::format("is damaged: has {} nodes where its header says `size {}`", tree->size(), head->size));
  return tree;
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
  const OctreeBytes tree = octree_bytes(map, binary);
  AtomicFile out(file);
  write_head(out.stream(), tree.nodes, map.grid().resolution, binary);
  out.stream() << tree.bytes;
  out.commit();
}

OccupancyMap read_octree(const std::filesystem::path& file, const InverseSensorModel& model) {
  model.validate();
  const auto tree = read_tree(file, model);
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
    throw std::runtime_error(
        fmt::format("{}: the octree spans {} voxels; at most {} are held", file.string(), grid.voxel_count(), most));
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
