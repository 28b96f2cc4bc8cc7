// How long frames of the window take, drawn by a software renderer (OSMesa) at 1280 x 800: while nothing happens, while
// the pointer moves over a panel, while a step or the Gibbs sampler runs and the scene stays as it is, and while the
// scene is turned. A distribution each, not a mean. A frame ends when its pixels are in memory.
//
// Wall time is what the user feels; it grows with whatever else the machine does. Processor time is of the thread that
// draws and of the renderer's own threads, without the workers': what the frame costs, also on a busy machine.
#include <fmt/format.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>
#include <vector>

#include "core/surface/surface_file.hpp"
#include "ui/commands/script.hpp"
#include "ui/render_target/headless.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/window/behind_drawing.hpp"
#include "ui/window/interface.hpp"

namespace nextview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double frame_interval = 1.0 / 60;  // [s] of a display

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Processor time of drawing so far [s]: this thread's, and that of the renderer's threads, which llvmpipe names after
/// itself.
double processor_seconds() {
  timespec own{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &own);
  double result = double(own.tv_sec) + 1e-9 * double(own.tv_nsec);
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    double nanoseconds = 0;
    std::getline(std::ifstream(thread.path() / "comm"), name);
    if (name.starts_with("llvmpipe") && std::ifstream(thread.path() / "schedstat") >> nanoseconds)
      result += 1e-9 * nanoseconds;
  }
  return result;
}

/// Of each frame [ms].
struct FrameTimes {
  std::vector<double> wall, processor;
};

void append(FrameTimes& times, const FrameTimes& more) {
  times.wall.insert(times.wall.end(), more.wall.begin(), more.wall.end());
  times.processor.insert(times.processor.end(), more.processor.begin(), more.processor.end());
}

class Window {
 public:
  Window() : target_(1280, 800), interface_(target_, worker_, inspector_) {}

  void load(const Configuration& configuration) {
    worker_.post(request::Load{configuration});
    settle();
  }
  void run(std::string_view script) {
    interface_.run_script(parse_script(script));
    settle();
  }
  void settle() {
    while (!interface_.is_still() || !interface_.is_drawn_well() || !interface_.script_is_done())
      interface_.draw(frame_interval);
  }

  /// Frames of the kept scene while what the script starts is under way.
  FrameTimes frames_while(std::string_view script) {
    interface_.run_script(parse_script(script));
    interface_.draw(frame_interval);
    FrameTimes times;
    while (worker_.progress().busy) {
      const auto start = Clock::now();
      FrameTimes frame;
      const std::size_t drawings = interface_.scene_drawings();
      draw_frame(frame);
      if (interface_.scene_drawings() == drawings) append(times, frame);
      const double left = frame_interval - seconds_since(start);
      if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    }
    settle();
    return times;
  }

  FrameTimes frames_idle(int count) {
    FrameTimes times;
    for (int i = 0; i < count; ++i) draw_frame(times);
    return times;
  }

  /// Frames while the pointer moves over the panel on the right.
  FrameTimes frames_hovering(int count) {
    const Rectangle& panel = interface_.layout().right;
    FrameTimes times;
    for (int i = 0; i < count; ++i) {
      interface_.push(input::Move{panel.x + panel.width / 2, panel.y + panel.height * i / count});
      draw_frame(times);
    }
    settle();
    return times;
  }

  /// Frames while the scene is turned by the pointer.
  FrameTimes frames_turning(int count) {
    const Rectangle& scene = interface_.layout().scene;
    const double x = scene.x + 30, y = scene.y + scene.height / 2;
    interface_.push(input::Move{x, y});
    interface_.push(input::Button{PointerButton::left, true});
    for (int i = 0; i < 3; ++i) interface_.draw(frame_interval);
    FrameTimes times;
    for (int i = 0; i < count; ++i) {
      interface_.push(input::Move{x + 3 * i, y});
      draw_frame(times);
    }
    interface_.push(input::Button{PointerButton::left, false});
    settle();
    interface_.draw(1.0);
    settle();
    return times;
  }

  /// Frames that draw the scene in full quality: those in which it comes to rest.
  FrameTimes frames_zooming(int count) {
    FrameTimes times;
    for (int i = 0; i < count; ++i) {
      interface_.run_script(parse_script(i % 2 ? "zoom 1\n" : "zoom -1\n"));
      while (!interface_.script_is_done() || !interface_.is_drawn_well()) {
        FrameTimes frame;
        draw_frame(frame);
        if (interface_.script_is_done() && interface_.is_drawn_well()) append(times, frame);
      }
    }
    settle();
    return times;
  }

  struct Drawn {
    FrameTimes first;  ///< what was asked for is seen
    FrameTimes still;  ///< and then with smooth edges
  };
  /// Those that draw the scene after each of these commands, as from a person.
  Drawn frames_after(const std::vector<std::string>& commands, int times_each) {
    Drawn times;
    for (int i = 0; i < times_each; ++i)
      for (const std::string& command : commands) {
        interface_.ask(parse_script(command + "\n").front());
        do {
          FrameTimes frame;
          const std::size_t drawings = interface_.scene_drawings();
          draw_frame(frame);
          const bool still = target_.window().GetMultiSamples() > 0;
          if (interface_.scene_drawings() > drawings) append(still ? times.still : times.first, frame);
        } while (!interface_.is_still() || !interface_.is_drawn_well());
      }
    return times;
  }

  std::size_t faces() { return interface_.scene().voxel_faces(); }

 private:
  void draw_frame(FrameTimes& times) {
    const auto start = Clock::now();
    const double processor = processor_seconds();
    interface_.draw(frame_interval);
    reinterpret_cast<void (*)()>(target_.gl_function("glFinish"))();
    times.wall.push_back(1e3 * seconds_since(start));
    times.processor.push_back(1e3 * (processor_seconds() - processor));
  }

  OffscreenTarget target_;
  SessionWorker worker_{stay_behind_drawing};
  InspectionWorker inspector_{stay_behind_drawing};
  Interface interface_;
};

void report(const std::string& what, FrameTimes times) {
  if (times.wall.empty()) return fmt::print("{:<36} no frames\n", what);
  const auto slow = std::count_if(times.wall.begin(), times.wall.end(), [](double t) { return t > 1000.0 / 30; });
  fmt::print("{:<36} {:>5}", what, times.wall.size());
  for (std::vector<double>* sorted : {&times.wall, &times.processor}) {
    std::sort(sorted->begin(), sorted->end());
    for (const double share : {0.5, 0.9, 0.99, 1.0})
      fmt::print(" {:7.1f}", (*sorted)[std::size_t(share * double(sorted->size() - 1))]);
    fmt::print("  ");
  }
  fmt::print("{:6.1f} %\n", 100.0 * double(slow) / double(times.wall.size()));
}

/// A ball with dents, of about this many triangles.
TriangleMesh dented_ball(int triangles) {
  const int rings = int(std::sqrt(triangles / 4.0)), around = 2 * rings;
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * i / rings, azimuth = 2 * std::numbers::pi * k / around;
      const double radius = 0.3 + 0.01 * std::sin(9 * polar) * std::cos(14 * azimuth);
      mesh.vertices.push_back(
          (radius * Vector3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)))
              .cast<float>());
    }
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const auto at = [&](int ring, int step) { return std::uint32_t(ring * around + step % around); };
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

/// What an operator waits for: a layer switched, triangles turned, a new map.
void measure_scene(Window& window) {
  window.load({});
  const auto maps = window.frames_after({"step"}, 8);
  report("new maps", maps.first);
  report("  the still pictures", maps.still);
  window.run("play\nwait until done\n");
  const auto layers = window.frames_after(
      {"toggle-octree", "toggle-cloud", "toggle-object", "toggle-missed", "toggle-views", "toggle-rays"}, 4);
  report("layers of a finished scan", layers.first);
  report("  the still pictures", layers.still);
  const auto file = std::filesystem::temp_directory_path() / "nextview_frame_times.stl";
  const TriangleMesh ball = dented_ball(870'000);
  write_stl(ball, file, "a ball with dents");
  window.run(fmt::format("open \"{}\"\nobject-style solid\n", file.string()));
  report(fmt::format("turning, {} triangles", ball.triangles.size()), window.frames_turning(60));
  report("  in full quality", window.frames_zooming(20));
  window.run("step\nstep\ntoggle-surface\nwait until done\ntoggle-object\n");
  report("turning, its surface", window.frames_turning(60));
  std::filesystem::remove(file);
  window.run("toggle-surface\ntoggle-object\nobject-style ghost\n");
}

void measure() {
  fmt::print("{:<36} {:>5} {:^33} {:^33} {:>8}\n", "", "", "wall time [ms]", "processor time [ms]", "wall");
  fmt::print("{:<36} {:>5}", "", "count");
  for (int i = 0; i < 2; ++i) fmt::print(" {:>7} {:>7} {:>7} {:>7}  ", "p50", "p90", "p99", "max");
  fmt::print("{:>8}\n", "> 33 ms");
  Window window;
  measure_scene(window);
  window.load({});
  window.run("step\nstep\n");
  report("nothing happens", window.frames_idle(200));
  report("pointer moves over a panel", window.frames_hovering(200));
  for (const char* panel : {"candidates", "view"}) {
    window.run(fmt::format("panel {}", panel));
    FrameTimes times;
    for (int i = 0; i < 6; ++i) append(times, window.frames_while("step\n"));
    report(fmt::format("steps, panel {}", panel), times);
  }
  report("Gibbs run", window.frames_while("refine\n"));
  report(fmt::format("turning, {} faces", window.faces()), window.frames_turning(100));
  Configuration fine;
  fine.map.region_edge = 0.8;
  fine.object.longest_side = 0.7;
  for (const double resolution : {0.008, 0.004}) {
    fine.map.resolution = resolution;
    window.load(fine);
    window.run("step\nstep\nstep\nstep\nstep\nstep\n");
    report(fmt::format("turning, {} faces", window.faces()), window.frames_turning(60));
  }
  report("  by keys, in full quality", window.frames_zooming(20));
  for (const char* layer : {"cloud", "object", "views", "rays", "region", "octree"}) {
    window.run(fmt::format("toggle-{}\n", layer));
    report(fmt::format("  without {}", layer), window.frames_turning(20));
  }
  window.run("toggle-cloud\ntoggle-object\ntoggle-views\ntoggle-rays\ntoggle-region\ntoggle-octree\n");
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
