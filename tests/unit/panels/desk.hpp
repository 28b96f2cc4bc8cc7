#pragma once
#include <imgui_internal.h>

#include <memory>
#include <set>

#include "tests/unit/workbench/small_scan.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/panels/all_panels.hpp"
#include "ui/window/imgui_host.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {

/// All panels in front of somebody with a mouse and a keyboard, and no pixels.
class Desk {
 public:
  explicit Desk(int width = 1280, int height = 800, double scale = 1.0,
                const std::vector<PanelEntry>& panels = standard_panels())
      : host_(scale), panels_(panels), layout_(width, height, scale), width_(width), height_(height), scale_(scale) {
    unsigned char* pixels = nullptr;
    int columns = 0, rows = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &columns, &rows);
  }

  /// A frame; returns what was emitted. What opens and closes palette, sheet and panels is done.
  std::vector<CommandCall> frame() {
    host_.take(queue_.take_frame());
    layout_ = Layout(width_, height_, scale_, window.open);
    host_.begin_frame(width_, height_, 1.0 / 60);
    std::vector<CommandCall> calls;
    std::optional<std::size_t> hovered;
    const PanelContext context{*snapshot, progress, window,  inspection,      log, host_.style(), pictures_,
                               calls,     hovered,  nullptr, surface_progress};
    panels_.obey_keys(context);
    panels_.draw(context, layout_, log.size(), 1.0 / 60);
    ImGui::Render();
    for (const CommandCall& call : calls) {
      CommandTarget target{worker_, window, *snapshot, progress};
      const bool is_window = call.command->menu == "Window" || call.command->menu == "Help";
      if (is_window && call.command->available(state()) && call.command->name != "assert") execute(call, target);
    }
    return calls;
  }
  /// Frames until all input was seen and windows have settled.
  std::vector<CommandCall> frames() {
    std::vector<CommandCall> all;
    for (int settled = 0; settled < 3; settled = queue_.empty() ? settled + 1 : 0)
      for (CommandCall& call : frame()) all.push_back(std::move(call));
    return all;
  }

  /// Frames for as long as it takes to read a question; Enter answers none before.
  void look() {
    for (int i = 0; i < 30; ++i) frame();
  }

  void move(double x, double y) { queue_.push(input::Move{x, y}); }
  void click(double x, double y) {
    move(x, y);
    queue_.push(input::Button{PointerButton::left, true});
    queue_.push(input::Button{PointerButton::left, false});
  }
  void type(Key key) {
    queue_.push(input::KeyChange{key, true});
    queue_.push(input::KeyChange{key, false});
  }
  void type_with(Key key, bool control, bool shift = false) {
    if (control) queue_.push(input::KeyChange{Key::control, true});
    if (shift) queue_.push(input::KeyChange{Key::shift, true});
    type(key);
    if (shift) queue_.push(input::KeyChange{Key::shift, false});
    if (control) queue_.push(input::KeyChange{Key::control, false});
  }
  void write(const std::string& text) {
    for (const char c : text) queue_.push(input::Text{static_cast<unsigned char>(c)});
  }

  CommandState state() const { return {*snapshot, progress, window}; }
  SessionWorker& worker() { return worker_; }
  const Layout& layout() const { return layout_; }

  std::shared_ptr<const SessionSnapshot> snapshot = std::make_shared<SessionSnapshot>();
  WorkerProgress progress;
  WindowState window;
  Inspection inspection;
  std::optional<SurfaceJob> surface_progress;
  SessionLog::Entries log;

 private:
  ImguiHost host_;
  AllPanels panels_;
  PanelPictures pictures_;
  InputQueue queue_;
  Layout layout_;
  SessionWorker worker_;
  int width_, height_;
  double scale_;
};

/// A scan after some steps.
inline std::shared_ptr<const SessionSnapshot> scanned(const Configuration& configuration, int steps,
                                                      bool refined = false) {
  const SessionRunner::JobControl control{[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
  SessionRunner runner;
  runner.load(configuration, control);
  for (int i = 0; i < steps; ++i) runner.step(control);
  if (refined) runner.refine(2, 20, control);
  return runner.snapshot();
}

/// A scan and a window in which all can be done that needs nothing to run.
inline void open_all_ways(Desk& desk) {
  auto s = std::make_shared<SessionSnapshot>(*scanned(small_scan(), 2));
  s->can_undo = s->can_redo = true;
  s->earlier_runs = std::make_shared<const std::vector<Run>>(1, Run{"sphere, random", s->records, s->object_name});
  s->next_candidate = *s->proposal() == 0 ? 1 : 0;
  auto timeline = std::make_shared<Timeline>(*s->timeline);
  timeline->branches.all.push_back({"other", 2, 1});
  timeline->at = 1;
  s->compared = std::make_shared<const Comparison>(Comparison{"other", std::make_shared<SessionSnapshot>(*s)});
  s->timeline = std::move(timeline);
  s->cameras = std::make_shared<const std::vector<CameraBookmark>>(1, CameraBookmark{"here"});
  desk.snapshot = s;
  desk.window.selection.view = {ViewSelection::Kind::candidate, *s->proposal()};
  desk.window.selection.custom_view = Pose::Identity();
  desk.window.measurement = Measurement{};
  desk.window.layers.voxels.slice = Slice{0, -0.1, 0.1};
  desk.window.layers.section = Section{0, 0.0, false};
}

/// What may be under way: nothing, playing, refining, a refinement that is paused.
inline std::vector<WorkerProgress> all_progress() {
  std::vector<WorkerProgress> all(5);
  for (std::size_t i = 1; i < 5; ++i) {
    all[i].busy = true;
    all[i].what = "doing what it does";
    all[i].fraction = 0.4;
    all[i].seconds_left = 12;
    all[i].playing = i == 1;
    all[i].refining = i == 2 || i == 3;
    all[i].paused = i == 3;
  }
  all[4].question = "Move the camera?";
  all[4].answers = {"Move", "Refuse"};
  return all;
}

}  // namespace nextview
