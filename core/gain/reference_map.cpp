#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/gain/map_rays.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

using octomap::KeyRay;
using octomap::KeySet;
using octomap::OcTreeKey;
using octomap::point3d;

/// Pruning and expansion copy the value only: the other fields of the node that is left, or made, start anew, as
/// measured.
class Node : public octomap::OcTreeNode {
 public:
  bool unmeasured = false;     ///< made by an occlusion traversal, and no measurement has landed here since
  int occlusion_distance = 0;  ///< 0: not behind a surface

  bool operator==(const Node& other) const {  // what pruning takes for equal
    return value == other.value && unmeasured == other.unmeasured && occlusion_distance == other.occlusion_distance;
  }
};

point3d to_octomap(const Vector3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

struct ReferenceMap::Tree : octomap::OccupancyOcTreeBase<Node> {
  using OccupancyOcTreeBase<Node>::OccupancyOcTreeBase;
  Tree* create() const override { return new Tree(resolution); }
  std::string getTreeType() const override { return "NextviewReferenceTree"; }

  /// OctoMap's own copying makes nodes of its own kind of ours.
  std::unique_ptr<Tree> copy() const {
    auto tree = std::make_unique<Tree>(resolution);
    tree->prob_hit_log = prob_hit_log;
    tree->prob_miss_log = prob_miss_log;
    tree->clamping_thres_min = clamping_thres_min;
    tree->clamping_thres_max = clamping_thres_max;
    tree->occ_prob_thres_log = occ_prob_thres_log;
    if (!root) return tree;
    tree->root = new Node;
    tree->tree_size = 1;
    tree->size_changed = true;
    tree->copy_node(*root, *tree->root);
    return tree;
  }

  void copy_node(const Node& from, Node& to) {
    to.setValue(from.getValue());
    to.unmeasured = from.unmeasured;
    to.occlusion_distance = from.occlusion_distance;
    for (unsigned i = 0; i < 8; ++i)
      if (nodeChildExists(&from, i)) copy_node(*getNodeChild(&from, i), *createNodeChild(&to, i));
  }

  void measure(const OcTreeKey& key, bool occupied) {
    Node* node = search(key);
    if (node && node->unmeasured) {
      node->setLogOdds(occupied ? prob_hit_log : prob_miss_log);  // for a collapsed block, the whole of it
      node->unmeasured = false;
    } else {
      updateNode(key, occupied);
    }
  }

  void occlude(const OcTreeKey& key, int distance) {
    Node* node = search(key);
    if (!node) {
      node = updateNode(key, false);  // may complete a block: then this is the whole of it
      node->unmeasured = true;
    }
    if (!node->unmeasured) return;
    if (node->occlusion_distance == 0 || distance < node->occlusion_distance) node->occlusion_distance = distance;
  }

  /// Looks for one key after the other from where their ways through the tree part: those along a ray share most of it.
  class Search {
   public:
    explicit Search(const Tree& tree) : tree_(tree) { path_[levels] = tree.root; }

    /// As search() finds it.
    const Node* find(const OcTreeKey& key) {
      if (!tree_.root) return nullptr;
      const unsigned parted =
          unsigned(key[0] ^ before_[0]) | unsigned(key[1] ^ before_[1]) | unsigned(key[2] ^ before_[2]);
      unsigned level = std::max(unsigned(std::bit_width(parted)), reached_);
      before_ = key;
      const Node* node = path_[level];
      for (; level > 0; --level) {
        const unsigned child = octomap::computeChildIdx(key, int(level) - 1);
        if (!tree_.nodeChildExists(node, child)) break;
        node = path_[level - 1] = tree_.getNodeChild(node, child);
      }
      reached_ = level;
      return level == 0 || !tree_.nodeHasChildren(node) ? node : nullptr;
    }

   private:
    static constexpr unsigned levels = 16;

    const Tree& tree_;
    OcTreeKey before_{0, 0, 0};
    std::array<const Node*, levels + 1> path_{};  ///< of the key before: at each level, the root's the last
    unsigned reached_ = levels;                   ///< the level that its search ended at
  };
};

ReferenceMap::ReferenceMap(const Parameters& parameters)
    : parameters_(parameters), tree_(std::make_unique<Tree>(parameters.resolution)) {
  parameters.model.validate();
  tree_->setProbHit(parameters.model.hit);
  tree_->setProbMiss(parameters.model.miss);
  tree_->setClampingThresMin(parameters.model.clamp_min);
  tree_->setClampingThresMax(parameters.model.clamp_max);
  tree_->setOccupancyThres(parameters.model.occupancy_threshold);
}

ReferenceMap::~ReferenceMap() = default;

std::unique_ptr<ReferenceMap> ReferenceMap::copy() const {
  auto map = std::make_unique<ReferenceMap>(parameters_);
  map->tree_ = tree_->copy();
  return map;
}

void ReferenceMap::insert(const Vector3& origin, std::span<const Eigen::Vector3f> points, const std::stop_token& stop) {
  const point3d from = to_octomap(origin);
  const auto outside = [&](const Eigen::Vector3f& p) {
    const Vector3 q = p.cast<double>();
    return parameters_.use_bounding_box &&
           ((q.array() < parameters_.lower.array()).any() || (q.array() > parameters_.upper.array()).any());
  };
  KeySet free, occupied;
  std::vector<point3d> inserted;
  KeyRay ray;
  constexpr std::size_t between_looks = 64;  // at the stop token
  std::size_t done = 0;
  const auto look = [&] {
    if (++done % between_looks == 0) throw_if_stopped(stop);
  };
  for (const Eigen::Vector3f& p : points) {
    look();
    if (outside(p)) continue;
    const point3d point(p.x(), p.y(), p.z());
    const double range_limit = parameters_.max_sensor_range;
    if (range_limit < 0.0 || (point - from).norm() <= range_limit + 1e-6) {
      if (tree_->computeRayKeys(from, point, ray)) free.insert(ray.begin(), ray.end());
      occupied.insert(tree_->coordToKey(point));
      inserted.push_back(point);
    } else {
      const point3d end = from + (point - from).normalized() * static_cast<float>(range_limit);
      if (tree_->computeRayKeys(from, end, ray)) free.insert(ray.begin(), ray.end());
    }
  }
  for (const OcTreeKey& key : free) {
    look();
    if (!occupied.count(key)) tree_->measure(key, false);
  }
  for (const OcTreeKey& key : occupied) {
    look();
    tree_->measure(key, true);
  }

  for (const point3d& point : inserted) {
    look();
    const point3d end = point + (point - from).normalized() * static_cast<float>(parameters_.occlusion_distance);
    if (!tree_->computeRayKeys(point, end, ray)) continue;
    int behind = -1;
    for (const OcTreeKey& key : ray) {
      if (++behind > 0) tree_->occlude(key, behind);  // no. 0 is the point's own voxel
    }
  }
}

void ReferenceMap::cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const {
  visited.clear();
  const point3d from = to_octomap(origin), along = to_octomap(direction);
  point3d end;
  if (!tree_->castRay(from, along, end, true, parameters_.max_ray_depth))
    end = from + along * static_cast<float>(parameters_.max_ray_depth);

  KeyRay keys;
  tree_->computeRayKeys(from, end, keys);
  Tree::Search search(*tree_);
  const double unknown_entropy = entropy(parameters_.unknown_prior);
  // Of the last measured voxel: the next one often has the same.
  float log_odds = std::numeric_limits<float>::quiet_NaN();
  double occupancy = 0.0, occupancy_entropy = 0.0;
  const auto visit = [&](const OcTreeKey& key) {
    RayVoxel& voxel = visited.emplace_back();
    for (int axis = 0; axis < 3; ++axis) voxel.lattice[axis] = static_cast<std::int16_t>(int(key[axis]) - 32768);
    const Node* node = search.find(key);
    voxel.has_node = node != nullptr;
    voxel.measured = node && !node->unmeasured;
    if (node) voxel.occlusion_distance = static_cast<std::uint16_t>(std::min(node->occlusion_distance, 65535));
    if (voxel.measured && node->getLogOdds() != log_odds) {
      log_odds = node->getLogOdds();
      occupancy = node->getOccupancy();
      occupancy_entropy = entropy(occupancy);
    }
    const double p = voxel.measured ? occupancy : parameters_.unknown_prior;
    voxel.probability = static_cast<float>(p);
    voxel.entropy = static_cast<float>(voxel.measured ? occupancy_entropy : unknown_entropy);
    voxel.voxel_class = parameters_.model.classify(p);
  };
  for (const OcTreeKey& key : keys) visit(key);
  visit(tree_->coordToKey(end));
}

}  // namespace nextview
