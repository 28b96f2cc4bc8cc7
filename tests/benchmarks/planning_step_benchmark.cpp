// A whole planning step (sense at 640 x 480, insert, score 48 candidates at 950 rays each by one gain) and its stages,
// against the same composed of OctoMap's own calls and what else there is. What is compared takes turns in one run, and
// the least of the rounds counts: ratios then say something on a machine that does other things too.
//   build/release/planning_step_benchmark [ROUNDS]           3 of them
//   build/release/planning_step_benchmark --avx2 [ROUNDS]    as on a processor without AVX-512
//   build/release/planning_step_benchmark --growth [ROUNDS]  how the stages grow with voxels, pixels, candidates, views
//   build/release/planning_step_benchmark --product          one round without peers: whether it runs
#include <fmt/format.h>
#include <hwy/targets.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdlib>
#include <optional>
#include <string_view>

#include "tests/benchmarks/planning_step.hpp"
#include "tests/benchmarks/planning_step_peers.hpp"

namespace nextview {
namespace {

/// Something timed, and what it is compared with.
struct Line {
  std::string_view name;
  std::function<void()> product;
  std::string_view peer = {};
  std::function<void()> theirs = {};
  LeastTime ours = {}, peers = {};
};

/// What a step is held against.
struct Peers {
  OctomapStep octomap;
  NanoVdbMap nano_vdb;
  SingleRays single_rays;
  std::vector<std::unique_ptr<MapPeer>> others;

  explicit Peers(const PlanningStep& step) : octomap(step), nano_vdb(step.map), single_rays(step.mesh) {
    for (const MakePeer make : peer_makers()) others.push_back(make(step));
  }
};

/// `peers`: null if there are none.
std::vector<Line> lines(PlanningStep& s, Peers* peers) {
  static const std::vector<Eigen::Vector3f> pixels = s.image_rays(PlanningStep::next_view);
  static std::vector<MeshRayCaster::Hit> found(pixels.size());
  const Vector3 eye = s.scan.origin;
  const auto step = [&s] {
    s.scan = s.sense(PlanningStep::next_view);
    s.insert();
    s.score();
  };
  const auto octomap_step = [&s, peers] {
    s.scan = s.sense(PlanningStep::next_view);
    peers->octomap.insert(s.scan, false);
    peers->octomap.score(s);
  };
  const auto insert = [&s] { s.insert(); };
  const auto score = [&s] { s.score(); };
  std::vector<Line> all = {
      {"cast an image's rays",
       [&s, eye] {
         // In parts, as sense() casts them.
         tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), 1024), [&](const auto& range) {
           s.scene.cast(eye, std::span(pixels).subspan(range.begin(), range.size()), s.max_range,
                        std::span(found).subspan(range.begin(), range.size()));
         });
       },
       "Embree, ray by ray (rtcIntersect1)", [&s, eye, peers] { peers->single_rays.cast(eye, pixels, s.max_range); }},
      {"sense, back-project", [&s] { s.scan = s.sense(PlanningStep::next_view); }},
      {"insert", insert, "OctoMap: insertPointCloud", [&s, peers] { peers->octomap.insert(s.scan, false); }},
      {"insert", insert, "... discretised and lazy", [&s, peers] { peers->octomap.insert(s.scan, true); }}};
  const std::span others = peers ? std::span(peers->others) : std::span<std::unique_ptr<MapPeer>>();
  for (const auto& peer : others) all.push_back({"insert", insert, peer->insertion(), [&peer] { peer->insert(); }});
  all.push_back({"score, occlusion-aware", score, "OctoMap: castRay, computeRayKeys, search",
                 [&s, peers] { peers->octomap.score(s); }});
  all.push_back({"score, occlusion-aware", score, "NanoVDB: DDA, getValue (all threads)",
                 [&s, peers] { peers->nano_vdb.score(s); }});
  for (const auto& peer : others)
    if (!peer->scoring().empty())
      all.push_back({"score, occlusion-aware", score, peer->scoring(), [&s, &peer] { peer->score(s); }});
  all.push_back({"score, new-surface", [&s] { s.score_new_surface(); }});
  all.push_back({"whole step", step, "composed of OctoMap's calls", octomap_step});
  return all;
}

void print(const std::vector<Line>& table, const PlanningStep& s) {
  fmt::print("{:<22}{:>8}{:>10}  {:<46}{:>8}{:>10}{:>8}{:>10}\n", "[ms]", "waited", "processor", "peer", "waited",
             "processor", "ratio", "per core");
  for (const Line& line : table) {
    fmt::print("{:<22}{:>8.1f}{:>10.1f}  {:<46}", line.name, line.ours.waited, line.ours.processor, line.peer);
    if (std::isfinite(line.peers.waited))
      fmt::print("{:>8.1f}{:>10.1f}{:>8.1f}{:>10.1f}", line.peers.waited, line.peers.processor,
                 line.peers.waited / line.ours.waited, line.peers.processor / line.ours.processor);
    fmt::print("\n");
  }
  const double rays = double(s.scan.hits.size() + s.scan.misses.size());
  fmt::print("\n{:.0f} rays inserted, {:.0f} scored over {:.1f} million voxels that could matter\n", rays,
             double(s.candidates.size() * s.bundle.directions.size()), 1e-6 * double(s.voxel_steps));
  const LeastTime &ours = table.back().ours, &peers = table.back().peers;
  if (std::isfinite(peers.waited))
    fmt::print(
        "\nA planning step is {:.1f} times faster than composed of OctoMap's calls ({:.1f} ms against {:.1f} ms).\n",
        peers.waited / ours.waited, ours.waited, peers.waited);
}

/// Of the region, before what is timed: a map that does less is none to compare with.
void print_occupied(const PlanningStep& s, const Peers& peers) {
  const auto is_occupied = [](const Voxel& voxel) { return voxel.measured && voxel.probability > 0.5f; };
  fmt::print("Occupied voxels: {}; OctoMap {}", std::ranges::count_if(s.map.voxels(), is_occupied),
             peers.octomap.occupied(s.map.grid()));
  for (const auto& peer : peers.others) fmt::print("; {} {}", peer->insertion(), peer->occupied(s.map.grid()));
  fmt::print("\n\n");
}

int run(int rounds, bool with_peers) {
  PlanningStep step;
  std::optional<Peers> peers;
  if (with_peers) peers.emplace(step);
  if (peers && !peers->others.empty()) print_occupied(step, *peers);
  std::vector<Line> table = lines(step, with_peers ? &*peers : nullptr);
  for (int round = 0; round < rounds; ++round)
    for (Line& line : table) {
      // What is fast gets more turns: its least is then as sure as the other's.
      for (int turn = 0; turn < (with_peers ? 10 : 1); ++turn) line.ours.keep(line.product);
      for (int turn = 0; with_peers && line.theirs && (turn == 0 || (turn < 10 && line.peers.waited < 200.0)); ++turn)
        line.peers.keep(line.theirs);
    }
  print(table, step);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == "--product") return nextview::run(1, false);
  const bool growth = first == "--growth", avx2 = first == "--avx2";
  const int count_at = growth || avx2 ? 2 : 1;
  const int rounds = std::max(1, std::atoi(argc > count_at ? argv[count_at] : "3"));
  if (avx2) hwy::DisableTargets(HWY_AVX2 - 1);  // the better an instruction set, the lower its bit
  if (!growth) return nextview::run(rounds, true);
  nextview::print_growth(rounds);
  return EXIT_SUCCESS;
}
