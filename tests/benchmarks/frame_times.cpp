// How long frames of the window take, drawn by a software renderer (OSMesa): while a step or the Gibbs sampler runs and
// the scene stays as it is, and while the scene is turned. A distribution each, not a mean.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <vector>

#include "ui/surface/headless.hpp"
#include "ui/surface/offscreen_surface.hpp"
#include "ui/window/interface.hpp"

namespace nextview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double frame_interval = 1.0 / 60;  // [s] of a display

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class Window {
 public:
  Window() : surface_(1280, 800), interface_(surface_, worker_, inspector_) {}

  void load(const Configuration& configuration) {
    worker_.post(request::Load{configuration});
    settle();
  }
  void run(std::string_view script) {
    interface_.run_script(parse_script(script));
    settle();
  }
  void settle() {
    while (interface_.seconds_to_next_frame() == 0 || worker_.progress().busy || inspector_.busy() ||
           !interface_.script_is_done())
      interface_.draw(frame_interval);
  }

  /// Frames of the kept scene while what the script starts is under way [ms].
  std::vector<double> frames_while(std::string_view script) {
    interface_.run_script(parse_script(script));
    interface_.draw(frame_interval);
    std::vector<double> times;
    while (worker_.progress().busy) {
      const auto start = Clock::now();
      const std::size_t drawings = interface_.scene_drawings();
      interface_.draw(frame_interval);
      const double seconds = seconds_since(start);
      if (interface_.scene_drawings() == drawings) times.push_back(1e3 * seconds);
      if (seconds < frame_interval)
        std::this_thread::sleep_for(std::chrono::duration<double>(frame_interval - seconds));
    }
    settle();
    return times;
  }

  /// Frames while the scene is turned by the pointer [ms].
  std::vector<double> frames_turning(int count) {
    const Rectangle& scene = interface_.layout().scene;
    const double x = scene.x + 30, y = scene.y + scene.height / 2;
    interface_.push(input::Move{x, y});
    interface_.push(input::Button{PointerButton::left, true});
    for (int i = 0; i < 3; ++i) interface_.draw(frame_interval);
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
      interface_.push(input::Move{x + 3 * i, y});
      const auto start = Clock::now();
      interface_.draw(frame_interval);
      times.push_back(1e3 * seconds_since(start));
    }
    interface_.push(input::Button{PointerButton::left, false});
    settle();
    return times;
  }

  std::size_t faces() { return interface_.scene().voxel_faces(); }

 private:
  OffscreenSurface surface_;
  SessionWorker worker_;
  InspectionWorker inspector_;
  Interface interface_;
};

void report(const char* what, std::vector<double> times) {
  if (times.empty()) return fmt::print("{:<44} no frames\n", what);
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) { return times[std::size_t(share * double(times.size() - 1))]; };
  const auto slow = std::count_if(times.begin(), times.end(), [](double t) { return t > 1000.0 / 30; });
  fmt::print("{:<44} {:>5} frames: p50 {:5.1f}  p90 {:5.1f}  p99 {:5.1f}  max {:5.1f} ms; over 33.3 ms: {:.1f} %\n",
             what, times.size(), at(0.5), at(0.9), at(0.99), times.back(), 100.0 * double(slow) / double(times.size()));
}

void measure() {
  Window window;
  window.load({});
  window.run("step\nstep\n");
  for (const char* panels : {"panel candidates", "panel view\npanel layers"}) {
    window.run(panels);
    std::vector<double> times;
    for (int i = 0; i < 6; ++i) {
      const auto more = window.frames_while("step\n");
      times.insert(times.end(), more.begin(), more.end());
    }
    report(fmt::format("steps, {}", panels).substr(0, 40).c_str(), times);
  }
  report("Gibbs run", window.frames_while("refine\n"));
  report(fmt::format("turning, {} faces", window.faces()).c_str(), window.frames_turning(100));
  Configuration fine;
  fine.map.resolution = 0.004;
  fine.map.region_edge = 0.8;
  fine.object.longest_side = 0.7;
  window.load(fine);
  window.run("step\nstep\nstep\nstep\nstep\nstep\n");
  report(fmt::format("turning, {} faces", window.faces()).c_str(), window.frames_turning(60));
  report("a step on that map", window.frames_while("step\n"));
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  try {
    nextview::ensure_headless(argc, argv);
    nextview::measure();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
