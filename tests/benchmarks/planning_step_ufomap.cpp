#include <ufo/map/occupancy_map.h>

#include "tests/benchmarks/planning_step_peers.hpp"

namespace nextview {
namespace {

/// Its octree. `discrete`: one ray for all points in a voxel, to the voxel's centre. It updates hits on a second thread
/// while it looks for free voxels. It is not scored: what it reads of a voxel (getNode) is the voxel's parent.
template <bool discrete>
class UfoMapPeer final : public MapPeer {
 public:
  explicit UfoMapPeer(const PlanningStep& step)
      : map_(step.map.grid().resolution), next_(cloud(step, PlanningStep::next_view)) {
    for (const int view : PlanningStep::views_before()) insert(cloud(step, view));
  }

  std::string_view insertion() const override {
    return discrete ? "... insertPointCloudDiscrete, a ray a voxel" : "UFOMap: insertPointCloud";
  }
  void insert() override { insert(next_); }
  std::size_t occupied(const VoxelGrid& grid) const override {
    std::size_t count = 0;
    for (auto leaf = map_.beginLeaves(true, false); leaf != map_.endLeaves(); ++leaf)
      if (grid.box().contains(Vector3(leaf.getX(), leaf.getY(), leaf.getZ())))
        count += std::size_t(1) << 3 * leaf.getDepth();
    return count;
  }

 private:
  struct Cloud {
    ufo::map::PointCloud points;
    ufo::map::Point3 origin;
  };

  static ufo::map::Point3 point(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }
  static Cloud cloud(const PlanningStep& step, int view) {
    const Scan scan = step.sense(view);
    Cloud cloud{{}, point(scan.origin.cast<float>())};
    for (const auto& p : scan.hits) cloud.points.push_back(point(p));
    for (const auto& p : scan.misses) cloud.points.push_back(point(beyond_range(scan, p)));
    return cloud;
  }
  void insert(const Cloud& cloud) {
    if constexpr (discrete)
      map_.insertPointCloudDiscrete(cloud.origin, cloud.points, PlanningStep::max_range);
    else
      map_.insertPointCloud(cloud.origin, cloud.points, PlanningStep::max_range);
  }

  ufo::map::OccupancyMap map_;
  Cloud next_;
};

const bool added = add_peer<UfoMapPeer<false>>() && add_peer<UfoMapPeer<true>>();

}  // namespace
}  // namespace nextview
