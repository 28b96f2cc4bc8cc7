#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

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
  const auto visit = [&](const OcTreeKey& key) {
    RayVoxel& voxel = visited.emplace_back();
    for (int axis = 0; axis < 3; ++axis) voxel.lattice[axis] = static_cast<std::int16_t>(int(key[axis]) - 32768);
    const Node* node = tree_->search(key);
    voxel.has_node = node != nullptr;
    voxel.measured = node && !node->unmeasured;
    if (node) voxel.occlusion_distance = static_cast<std::uint16_t>(std::min(node->occlusion_distance, 65535));
    const double p = voxel.measured ? node->getOccupancy() : parameters_.unknown_prior;
    voxel.probability = static_cast<float>(p);
    voxel.entropy = static_cast<float>(entropy(p));
    voxel.voxel_class = parameters_.model.classify(p);
  };
  for (const OcTreeKey& key : keys) visit(key);
  visit(tree_->coordToKey(end));
}

}  // namespace nextview
