// A whole planning step (sense at 640 x 480, insert, score 48 candidates at 950 rays each by one gain) and its stages,
// against the same composed of OctoMap's own calls. What is compared takes turns in one run, and the least of the
// rounds counts: ratios then say something on a machine that does other things too.
//   build/release/planning_step_benchmark [ROUNDS]     3 of them
//   build/release/planning_step_benchmark --product    one round without OctoMap: whether it runs
#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <string_view>

#include "core/config/configuration.hpp"
#include "core/gain/map_rays.hpp"
#include "core/gain/new_surface.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

constexpr double max_range = 1.5;
constexpr int views_before = 5;  // the map is neither empty nor done

/// The default scan's parts, and a map after a few views; as OctoMap's trees, too, once fill_trees() was called.
struct Setup {
  Configuration configuration;
  TriangleMesh mesh = load_mesh(default_object());
  MeshRayCaster scene{mesh};
  DepthCamera camera{configuration.sensor};
  std::vector<Pose> candidates = candidate_views(configuration.views, Vector3::Zero());
  RayBundle bundle = RayBundle::regular(camera.camera());
  OccupancyMap map{region_of_interest(Vector3::Zero(), 1.28, 0.01), InverseSensorModel{}};
  octomap::OcTree tree{0.01}, discretised_tree{0.01};
  Scan scan = sense(20);
  std::size_t voxel_steps = 0;

  Setup() {
    for (int v = 0; v < views_before; ++v) map.insert(sense(9 * v));
  }
  /// It takes long, and only OctoMap's calls need them.
  void fill_trees() {
    for (int v = 0; v < views_before; ++v) {
      insert_into(tree, sense(9 * v), false);
      insert_into(discretised_tree, sense(9 * v), true);
    }
  }
  Scan sense(int view) const {
    return back_project(camera.sense(scene, candidates[view], 1, view), candidates[view], max_range);
  }
  /// `discretised`: one ray for all points in a voxel, which misses some voxels, and inner nodes updated at the end.
  void insert_into(octomap::OcTree& into, const Scan& from, bool discretised) const {
    octomap::Pointcloud cloud;
    const Eigen::Vector3f origin = from.origin.cast<float>();
    for (const auto& p : from.hits) cloud.push_back(p.x(), p.y(), p.z());
    for (const auto& p : from.misses) {  // a little beyond the range, so that they carve and do not hit
      const Eigen::Vector3f q = origin + 1.01f * (p - origin);
      cloud.push_back(q.x(), q.y(), q.z());
    }
    into.insertPointCloud(cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), max_range, discretised,
                          discretised);
    if (discretised) into.updateInnerOccupancy();
  }
  void score() {
    const Gain* const gain = &nextview::gain("occlusion-aware");
    const MapRays rays(map.grid(), map.voxels(), map.model().occupancy_threshold, max_range);
    voxel_steps = 0;
    for (const ViewScore& view : score_views(rays, candidates, bundle, {&gain, 1})) voxel_steps += view.voxels;
  }
  void score_new_surface() const {
    const SurfaceEvidence evidence(map.grid(), map.voxels(), map.voxels(), map.model().occupancy_threshold);
    forecast_new_surface({evidence, NewSurfaceModel::fitted()}, candidates, bundle, {});
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

/// The least of several rounds [ms].
struct Least {
  double waited = std::numeric_limits<double>::infinity();
  double processor = waited;  ///< of all threads

  void keep(const std::function<void()>& work) {
    const std::clock_t processor_start = std::clock();
    const auto start = std::chrono::steady_clock::now();
    work();
    waited =
        std::min(waited, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    processor = std::min(processor, 1e3 * double(std::clock() - processor_start) / CLOCKS_PER_SEC);
  }
};

/// Something timed, and what it is compared with.
struct Line {
  std::string_view name;
  std::function<void()> product;
  std::string_view peer = {};
  std::function<void()> theirs = {};
  Least ours = {}, peers = {};
};

std::vector<Line> lines(Setup& s) {
  const auto step = [&s] {
    s.scan = s.sense(20);
    s.map.insert(s.scan);
    s.score();
  };
  const auto octomap_step = [&s] {
    s.scan = s.sense(20);
    s.insert_into(s.tree, s.scan, false);
    s.score_with_octomap();
  };
  const auto insert = [&s] { s.map.insert(s.scan); };
  return {
      {"sense, back-project", [&s] { s.scan = s.sense(20); }},
      {"insert", insert, "OctoMap: insertPointCloud", [&s] { s.insert_into(s.tree, s.scan, false); }},
      {"insert", insert, "... discretised and lazy", [&s] { s.insert_into(s.discretised_tree, s.scan, true); }},
      {"score, occlusion-aware", [&s] { s.score(); }, "OctoMap: castRay, computeRayKeys, search",
       [&s] { s.score_with_octomap(); }},
      {"score, new-surface", [&s] { s.score_new_surface(); }},
      {"whole step", step, "composed of OctoMap's calls", octomap_step},
  };
}

void print(const std::vector<Line>& table, const Setup& s) {
  fmt::print("{:<22}{:>8}{:>10}  {:<42}{:>8}{:>10}{:>8}{:>10}\n", "[ms]", "waited", "processor", "peer", "waited",
             "processor", "ratio", "per core");
  for (const Line& line : table) {
    fmt::print("{:<22}{:>8.1f}{:>10.1f}  {:<42}", line.name, line.ours.waited, line.ours.processor, line.peer);
    if (std::isfinite(line.peers.waited))
      fmt::print("{:>8.1f}{:>10.1f}{:>8.1f}{:>10.1f}", line.peers.waited, line.peers.processor,
                 line.peers.waited / line.ours.waited, line.peers.processor / line.ours.processor);
    fmt::print("\n");
  }
  const double rays = double(s.scan.hits.size() + s.scan.misses.size());
  fmt::print("\n{:.0f} rays inserted, {:.0f} scored over {:.1f} million voxels that could matter\n", rays,
             double(s.candidates.size() * s.bundle.directions.size()), 1e-6 * double(s.voxel_steps));
  const Least &ours = table.back().ours, &peers = table.back().peers;
  if (std::isfinite(peers.waited))
    fmt::print(
        "\nA planning step is {:.1f} times faster than composed of OctoMap's calls ({:.1f} ms against {:.1f} ms).\n",
        peers.waited / ours.waited, ours.waited, peers.waited);
}

int run(int rounds, bool with_peers) {
  Setup setup;
  if (with_peers) setup.fill_trees();
  std::vector<Line> table = lines(setup);
  for (int round = 0; round < rounds; ++round)
    for (Line& line : table) {
      // What is fast gets more turns: its least is then as sure as the other's.
      for (int turn = 0; turn < (with_peers ? 10 : 1); ++turn) line.ours.keep(line.product);
      if (with_peers && line.theirs) line.peers.keep(line.theirs);
    }
  print(table, setup);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  const std::string_view argument = argc > 1 ? argv[1] : "";
  if (argument == "--product") return nextview::run(1, false);
  return nextview::run(argument.empty() ? 3 : std::max(1, std::atoi(argv[1])), true);
}
