// What the operator's window draws, in numbers: finding the exposed faces of a map, making them vertices, colouring
// them anew, and turning the map in the window's scene with OSMesa (llvmpipe).
//   build/release/scene_benchmark                all of it
//   build/release/scene_benchmark --frames 600   more frames for the distribution
#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkGenericOpenGLRenderWindow.h>


#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>

#include "core/random/counter_random.hpp"
#include "ui/layers/voxel_polydata.hpp"
#include "ui/scene.hpp"
#include "ui/surface/headless.hpp"
#include "ui/surface/offscreen_surface.hpp"

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

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The median of some runs [ms].
double median(const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < 7; ++i) times.push_back(milliseconds(work));
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  return times[3];
}

void measure_faces(int edge, double radius) {
  const Map map = dented_ball(edge, radius);
  std::vector<VoxelFace> faces;
  const double found = median([&] { faces = exposed_faces(map.grid, map.voxels, {}); });
  const double made = median([&] { voxel_polydata(map.grid, faces); });
  fmt::print("{:4}^3 voxels: {:8} exposed faces found in {:7.1f} ms ({:.2f} ns a voxel), vertices made in {:6.1f} ms\n",
             edge, faces.size(), found, found * 1e6 / double(map.voxels.size()), made);
}

/// Turns the map once around and prints how long frames took.
void measure_turning(int edge, double radius, int frames) {
  const Map map = dented_ball(edge, radius);
  OffscreenSurface surface(1280, 800);
  Scene scene;
  scene.attach(surface, {269 / 1280.0, 250 / 800.0, 944 / 1280.0, 740 / 800.0});  // 675 x 490, as in the window
  scene.octree().show(map.grid, map.voxels);
  scene.frame();
  if (getenv("MS")) surface.window().SetMultiSamples(atoi(getenv("MS")));
  if (getenv("NOVOX")) scene.octree().set_visible(false);
  const auto finish = reinterpret_cast<void (*)()>(surface.gl_function("glFinish"));
  const auto draw = [&] {
    surface.render();
    finish();
  };
  const double first = milliseconds(draw);
  std::vector<double> times;
  const std::clock_t clock_before = std::clock();
  for (int i = 0; i < frames; ++i) {
    scene.renderer().GetActiveCamera()->Azimuth(360.0 / frames);
    times.push_back(milliseconds(draw));
  }
  const double busy = 1e3 * double(std::clock() - clock_before) / CLOCKS_PER_SEC / frames;
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) { return times[std::size_t(share * double(times.size() - 1))]; };
  fmt::print(
      "turning {} faces: first frame {:.0f} ms; then p50 {:.1f}, p90 {:.1f}, p99 {:.1f}, max {:.1f} ms; {:.1f} ms of "
      "all cores a frame\n",
      scene.octree().face_count(), first, at(0.5), at(0.9), at(0.99), times.back(), busy);
  scene.octree().set_visible(false);
  fmt::print("  without the map: {:.1f} ms\n", median(draw));
  scene.octree().set_visible(true);
  const double colouring = milliseconds([&] { scene.octree().set_colouring(VoxelColouring::by_entropy); });
  fmt::print("  another colouring: {:.1f} ms, and {:.1f} ms for the frame after it\n", colouring, milliseconds(draw));
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::ensure_headless(argc, argv);
  CLI::App app("What drawing the operator's scene costs");
  int frames = 180;
  bool turning_only = false;
  app.add_option("--frames", frames, "frames of a turn around the map")->check(CLI::PositiveNumber);
  app.add_flag("--turning-only", turning_only, "leave out the making of faces");
  CLI11_PARSE(app, argc, argv);
  if (!turning_only) {
    nextview::measure_faces(128, 52);
    nextview::measure_faces(256, 56);
    nextview::measure_faces(256, 110);
    nextview::measure_faces(400, 140);
  }
  nextview::measure_turning(256, 56, frames);
}
