// What the operator's window draws, in numbers: finding the exposed faces of a map, making them vertices, colouring
// them anew, and turning the map in the window's scene with OSMesa (llvmpipe).
//   build/release/scene_benchmark                all of it
//   build/release/scene_benchmark --frames 600   more frames for the distribution
//   build/release/scene_benchmark --small        of a small map only: that it runs
#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>

#include "core/random/counter_random.hpp"
#include "ui/layers/voxel_polydata.hpp"
#include "ui/render_target/headless.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {
namespace {

struct Map {
  VoxelGrid grid;
  std::vector<Voxel> voxels;
};

/// A dented ball with an uneven skin, as a scan leaves it: some of the skin unsure, free space around, nothing known
/// inside. `radius` [voxels].
Map dented_ball(int edge, double radius) {
  Map map{region_of_interest(Vector3::Zero(), 0.005 * edge, 0.005), {}};
  map.voxels.resize(map.grid.voxel_count());
  const CounterRandom random(11, 910);
  for (std::uint32_t i = 0; i < map.voxels.size(); ++i) {
    const Vector3 p = map.grid.centre(i) / map.grid.resolution;
    const double distance = p.norm();
    const double skin = radius * (1 + 0.08 * std::sin(0.11 * p.x()) * std::sin(0.13 * p.y()) * std::cos(0.12 * p.z()));
    if (distance < skin - 1.5) continue;
    const auto draw = random.uniform(i);
    const double probability = distance > skin + 0.5 ? 0.13 : std::min(0.97, 0.6 + 0.5 * draw[0]);
    map.voxels[i] = {float(probability), float(entropy(probability)), InverseSensorModel{}.classify(probability), true,
                     0};
  }
  return map;
}

/// What some work takes [ms]: until it is done, and summed over all cores, which other programs disturb less.
struct Cost {
  double wall = 0.0, cores = 0.0;
};

Cost cost(const std::function<void()>& work) {
  const std::clock_t clock_before = std::clock();
  const auto start = std::chrono::steady_clock::now();
  work();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
          1e3 * double(std::clock() - clock_before) / CLOCKS_PER_SEC};
}

/// The medians of some runs.
Cost median(const std::function<void()>& work) {
  std::vector<double> wall, cores;
  for (int i = 0; i < 7; ++i) {
    const Cost one = cost(work);
    wall.push_back(one.wall);
    cores.push_back(one.cores);
  }
  std::sort(wall.begin(), wall.end());
  std::sort(cores.begin(), cores.end());
  return {wall[3], cores[3]};
}

void measure_faces(int edge, double radius) {
  const Map map = dented_ball(edge, radius);
  std::vector<VoxelFace> faces;
  const Cost found = median([&] { faces = exposed_faces(map.grid, map.voxels, {}); });
  const Cost made = median([&] { voxel_polydata(map.grid, faces); });
  const double count = double(map.voxels.size());
  fmt::print(
      "{}^3 voxels: {} exposed faces found in {:.1f} ms ({:.2f} ns a voxel; {:.2f} summed over the cores), vertices "
      "made in {:.1f} ms ({:.1f})\n",
      edge, faces.size(), found.wall, found.wall * 1e6 / count, found.cores * 1e6 / count, made.wall, made.cores);
}

/// Turns the map once around and prints how long frames took.
void measure_turning(int edge, double radius, int frames, bool moving) {
  const Map map = dented_ball(edge, radius);
  OffscreenTarget target(1280, 800);
  Scene scene;
  scene.attach(target, {269 / 1280.0, 250 / 800.0, 944 / 1280.0, 740 / 800.0});  // 675 x 490, as in the window
  scene.octree().show(map.grid, map.voxels);
  scene.frame();
  scene.set_quality(moving ? DrawingQuality::moving : DrawingQuality::still);
  const auto finish = reinterpret_cast<void (*)()>(target.gl_function("glFinish"));
  const auto draw = [&] {
    target.render();
    finish();
  };
  const Cost first = cost(draw);
  std::vector<double> times;
  double cores = 0.0;
  for (int i = 0; i < frames; ++i) {
    scene.renderer().GetActiveCamera()->Azimuth(360.0 / frames);
    const Cost frame = cost(draw);
    times.push_back(frame.wall);
    cores += frame.cores / frames;
  }
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) { return times[std::size_t(share * double(times.size() - 1))]; };
  fmt::print(
      "turning {} faces, {}: p50 {:.1f}, p90 {:.1f}, p99 {:.1f}, max {:.1f} ms; {:.1f} ms a frame summed over the "
      "cores; the first frame took {:.0f} ms\n",
      scene.octree().face_count(), moving ? "edges as when moving" : "edges as at rest", at(0.5), at(0.9), at(0.99),
      times.back(), cores, first.wall);
  const Cost colouring = cost([&] { scene.octree().set_colouring(VoxelColouring::by_entropy); });
  fmt::print("  another colouring: {:.1f} ms, and {:.1f} ms for the frame after it\n", colouring.wall, cost(draw).wall);
  scene.octree().set_visible(false);
  const Cost without = median(draw);
  fmt::print("  without the map: {:.1f} ms ({:.1f} summed over the cores)\n", without.wall, without.cores);
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::ensure_headless(argc, argv);
  CLI::App app("What drawing the operator's scene costs");
  int frames = 180;
  bool turning_only = false, small = false;
  app.add_option("--frames", frames, "frames of a turn around the map")->check(CLI::PositiveNumber);
  app.add_flag("--turning-only", turning_only, "leave out the making of faces");
  app.add_flag("--small", small, "of a small map only");
  CLI11_PARSE(app, argc, argv);
  if (small) {
    nextview::measure_faces(64, 26);
    nextview::measure_turning(64, 26, frames, true);
    return 0;
  }
  if (!turning_only) {
    nextview::measure_faces(128, 52);
    nextview::measure_faces(256, 56);
    nextview::measure_faces(256, 110);
    nextview::measure_faces(400, 140);
  }
  for (const bool moving : {false, true}) {
    nextview::measure_turning(256, 56, frames, moving);
    nextview::measure_turning(400, 140, frames, moving);
  }
}
