// A whole planning step (sense at 640 x 480, insert, score 48 candidates at 950 rays each by one gain), and the same
// step composed of OctoMap's own calls, in one run; then each stage alone with its rays and voxel steps per second.
//   build/release/planning_step_benchmark                          both, on all threads
//   build/release/planning_step_benchmark --benchmark_filter=Step  the two whole steps only
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <map>
#include <memory>

#include "core/config/configuration.hpp"
#include "core/gain/map_rays.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

constexpr double max_range = 1.5;
constexpr int views_before = 5;  // the map is neither empty nor done

/// The default scan's parts, and a map after a few views; as OctoMap's tree, too, once fill_tree() was called.
struct Setup {
  Configuration configuration;
  TriangleMesh mesh = load_mesh(default_object());
  MeshRayCaster scene{mesh};
  DepthCamera camera{configuration.sensor};
  std::vector<Pose> candidates = candidate_views(configuration.views, Vector3::Zero());
  RayBundle bundle = RayBundle::regular(camera.camera());
  OccupancyMap map{region_of_interest(Vector3::Zero(), 1.28, 0.01), InverseSensorModel{}};
  octomap::OcTree tree{0.01};
  const Gain* gain = &nextview::gain("occlusion-aware");

  Setup() {
    for (int v = 0; v < views_before; ++v) map.insert(sense(9 * v));
  }
  /// It takes long, and only the step of OctoMap's calls needs it.
  void fill_tree() {
    if (tree.size() > 0) return;
    for (int v = 0; v < views_before; ++v) insert_into_tree(sense(9 * v));
  }
  Scan sense(int view) const {
    return back_project(camera.sense(scene, candidates[view], 1, view), candidates[view], max_range);
  }
  void insert_into_tree(const Scan& scan) {
    octomap::Pointcloud cloud;
    const Eigen::Vector3f origin = scan.origin.cast<float>();
    for (const auto& p : scan.hits) cloud.push_back(p.x(), p.y(), p.z());
    for (const auto& p : scan.misses) {  // a little beyond the range, so that they carve and do not hit
      const Eigen::Vector3f q = origin + 1.01f * (p - origin);
      cloud.push_back(q.x(), q.y(), q.z());
    }
    tree.insertPointCloud(cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), max_range);
  }
  std::vector<ViewScore> score() const {
    const MapRays rays(map.grid(), map.voxels(), map.model().occupancy_threshold, max_range);
    return score_views(rays, candidates, bundle, std::span(&gain, 1));
  }
  double score_with_octomap() const {
    double best = 0.0;
    octomap::KeyRay keys;
    for (const Pose& view : candidates) {
      const Eigen::Vector3f o = view.translation().cast<float>();
      const octomap::point3d origin(o.x(), o.y(), o.z());
      double sum = 0.0;
      for (const Vector3& direction : bundle.directions) {
        const Eigen::Vector3f d = (view.linear() * direction).cast<float>();
        const octomap::point3d along(d.x(), d.y(), d.z());
        octomap::point3d end;
        if (!tree.castRay(origin, along, end, true, max_range)) end = origin + along * static_cast<float>(max_range);
        tree.computeRayKeys(origin, end, keys);
        double visibility = 1.0;
        for (const octomap::OcTreeKey& key : keys) {
          const octomap::OcTreeNode* node = tree.search(key);
          const double p = node ? node->getOccupancy() : 0.5;
          sum += visibility * entropy(p);
          visibility *= 1.0 - p;
        }
      }
      best = std::max(best, sum);
    }
    return best;
  }
};

Setup& setup() {
  static Setup instance;
  return instance;
}

void Step_Nextview(benchmark::State& state) {
  Setup& s = setup();
  for (auto _ : state) {
    const Scan scan = s.sense(20);
    s.map.insert(scan);
    benchmark::DoNotOptimize(s.score());
  }
}

void Step_OctoMap(benchmark::State& state) {
  Setup& s = setup();
  s.fill_tree();
  for (auto _ : state) {
    const Scan scan = s.sense(20);
    s.insert_into_tree(scan);
    benchmark::DoNotOptimize(s.score_with_octomap());
  }
}

void Stage_Sense(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(setup().camera.sense(setup().scene, setup().candidates[20], 1, 20));
  state.counters["rays/s"] = benchmark::Counter(640.0 * 480.0, benchmark::Counter::kIsIterationInvariantRate);
}

void Stage_Insert(benchmark::State& state) {
  Setup& s = setup();
  const Scan scan = s.sense(20);
  for (auto _ : state) s.map.insert(scan);
  state.counters["rays/s"] =
      benchmark::Counter(double(scan.hits.size() + scan.misses.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void Stage_Score(benchmark::State& state) {
  Setup& s = setup();
  double rays = 0.0, voxels = 0.0;
  for (const ViewScore& v : s.score()) {
    rays += double(v.rays);
    voxels += double(v.voxels);
  }
  for (auto _ : state) benchmark::DoNotOptimize(s.score());
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["voxel steps/s"] = benchmark::Counter(voxels, benchmark::Counter::kIsIterationInvariantRate);
}

// Real time: what a user waits for, on all threads. The median of repetitions that take turns with the other step's.
BENCHMARK(Step_Nextview)->Unit(benchmark::kMillisecond)->UseRealTime()->Repetitions(5)->ReportAggregatesOnly();
BENCHMARK(Step_OctoMap)->Unit(benchmark::kMillisecond)->UseRealTime()->Repetitions(5)->ReportAggregatesOnly();
BENCHMARK(Stage_Sense)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Stage_Insert)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Stage_Score)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Prints as always, and keeps the medians for the ratio.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.aggregate_name == "median") median_[run.run_name.function_name] = run.GetAdjustedRealTime();
  }
  void print_ratio() const {
    const auto ours = median_.find("Step_Nextview"), octomap = median_.find("Step_OctoMap");
    if (ours == median_.end() || octomap == median_.end()) return;
    fmt::print(
        "\nA planning step is {:.1f} times faster than composed of OctoMap's calls ({:.1f} ms against {:.1f} ms, "
        "medians).\n",
        octomap->second / ours->second, ours->second, octomap->second);
  }

 private:
  std::map<std::string, double> median_;
};

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  nextview::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratio();
}
