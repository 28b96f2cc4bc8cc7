#include <bonxai_map/probabilistic_map.hpp>

#include "tests/benchmarks/planning_step_peers.hpp"
#include "tests/benchmarks/planning_step_walk.hpp"

namespace nextview {
namespace {

/// Its map of probabilities, made after OctoMap's: one ray for all points in a voxel, along a line of voxels that touch
/// at corners too, on one thread.
class BonxaiPeer final : public MapPeer {
  auto reader() const {
    return [this] {
      return [accessor = map_.grid().createConstAccessor()](int x, int y, int z) -> double {
        const Bonxai::ProbabilisticMap::CellT* const cell = accessor.value({x, y, z});
        return cell ? Bonxai::ProbabilisticMap::prob(cell->probability_log) : 0.5;
      };
    };
  }

 public:
  explicit BonxaiPeer(const PlanningStep& step)
      : map_(step.map.grid().resolution), next_(cloud(step, PlanningStep::next_view)) {
    for (const int view : PlanningStep::views_before()) insert(cloud(step, view));
  }

  std::string_view insertion() const override { return "Bonxai: insertPointCloud, a ray a voxel"; }
  std::string_view scoring() const override { return "Bonxai: DDA, ConstAccessor (all threads)"; }
  void insert() override { insert(next_); }
  double score(const PlanningStep& step) const override { return best_score(step, reader()); }
  std::size_t occupied(const VoxelGrid& grid) const override { return occupied_voxels(grid, reader()); }

 private:
  struct Cloud {
    std::vector<Vector3> points;
    Vector3 origin;
  };

  static Cloud cloud(const PlanningStep& step, int view) {
    const Scan scan = step.sense(view);
    Cloud cloud{{}, scan.origin};
    for (const auto& p : scan.hits) cloud.points.push_back(p.cast<double>());
    for (const auto& p : scan.misses) cloud.points.push_back(beyond_range(scan, p).cast<double>());
    return cloud;
  }
  void insert(const Cloud& cloud) { map_.insertPointCloud(cloud.points, cloud.origin, PlanningStep::max_range); }

  Bonxai::ProbabilisticMap map_;
  Cloud next_;
};

const bool added = add_peer<BonxaiPeer>();

}  // namespace
}  // namespace nextview
