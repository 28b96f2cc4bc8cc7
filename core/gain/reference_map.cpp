#include <octomap/OccupancyOcTreeBase.h>
#include <octomap/OcTreeNode.h>

#include "core/gain/map_rays.hpp"

namespace nextview {
namespace {

using octomap::KeyRay;
using octomap::KeySet;
using octomap::OcTreeKey;
using octomap::point3d;

/// Expansion and pruning copy the value only: the other two fields keep what the node had.
class Node : public octomap::OcTreeNode {
 public:
  bool measured = false;
  int occlusion_distance = 0;  ///< 0: not behind a surface
};

point3d to_octomap(const Vector3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

struct ReferenceMap::Tree : octomap::OccupancyOcTreeBase<Node> {
  using OccupancyOcTreeBase<Node>::OccupancyOcTreeBase;
  Tree* create() const override { return new Tree(resolution); }
  std::string getTreeType() const override { return "NextviewReferenceTree"; }

  void measure(const OcTreeKey& key, bool occupied) {
    Node* node = search(key);
    if (node && !node->measured) {
      node->setLogOdds(occupied ? prob_hit_log : prob_miss_log);  // for a collapsed block, the whole of it
    } else {
      node = updateNode(key, occupied, true);
    }
    node->measured = true;
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

void ReferenceMap::insert(const Vector3& origin, std::span<const Eigen::Vector3f> points) {
  const point3d from = to_octomap(origin);
  const auto outside = [&](const Eigen::Vector3f& p) {
    const Vector3 q = p.cast<double>();
    return parameters_.use_bounding_box &&
           ((q.array() < parameters_.lower.array()).any() || (q.array() > parameters_.upper.array()).any());
  };
  KeySet free, occupied;
  std::vector<point3d> inserted;
  KeyRay ray;
  for (const Eigen::Vector3f& p : points) {
    if (outside(p)) continue;
    const point3d point(p.x(), p.y(), p.z());
    if ((point - from).norm() <= parameters_.max_sensor_range) {
      if (tree_->computeRayKeys(from, point, ray)) free.insert(ray.begin(), ray.end());
      occupied.insert(tree_->coordToKey(point));
      inserted.push_back(point);
    } else {
      const point3d end = from + (point - from).normalized() * static_cast<float>(parameters_.max_sensor_range);
      if (tree_->computeRayKeys(from, end, ray)) free.insert(ray.begin(), ray.end());
    }
  }
  for (const OcTreeKey& key : free)
    if (!occupied.count(key)) tree_->measure(key, false);
  for (const OcTreeKey& key : occupied) tree_->measure(key, true);

  for (const point3d& point : inserted) {
    const point3d end = point + (point - from).normalized() * static_cast<float>(parameters_.occlusion_distance);
    if (!tree_->computeRayKeys(point, end, ray)) continue;
    int behind = -1;
    for (const OcTreeKey& key : ray) {
      if (++behind == 0) continue;  // the point's own voxel
      Node* node = tree_->search(key);
      if (!node) node = tree_->updateNode(key, false);
      if (node->measured) continue;
      if (node->occlusion_distance == 0 || behind < node->occlusion_distance) node->occlusion_distance = behind;
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
    if (!node) return;
    voxel.measured = node->measured;
    voxel.occlusion_distance = static_cast<std::uint8_t>(std::min(node->occlusion_distance, 255));
    if (!node->measured) return;
    const double p = node->getOccupancy();
    voxel.probability = static_cast<float>(p);
    voxel.entropy = static_cast<float>(entropy(p));
    voxel.voxel_class = parameters_.model.classify(p);
  };
  for (const OcTreeKey& key : keys) visit(key);
  visit(tree_->coordToKey(end));
}

}  // namespace nextview
