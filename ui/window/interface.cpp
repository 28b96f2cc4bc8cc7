#include "ui/window/interface.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/commands/starting_script.hpp"
#include "ui/panels/all_panels.hpp"
#include "ui/window/frame_composer.hpp"
#include "ui/window/imgui_host.hpp"
#include "ui/window/panels_alone.hpp"
#include "ui/window/scene_pointer.hpp"
#include "ui/window/selection_overlay.hpp"

namespace nextview {
namespace {

/// ImGui's windows settle within a few frames.
constexpr int frames_to_settle = 3;
/// The remaining time of a job is told in whole seconds.
constexpr double longest_wait_while_busy = 1.0;

/// The camera is at rest when it did not move for so long [s].
constexpr double rest = 0.15;

/// What is drawn in one frame; the next one may have other news.
struct News {
  std::shared_ptr<const SessionSnapshot> snapshot;
  WorkerProgress progress;
  std::shared_ptr<const Inspection> inspection;
  std::shared_ptr<const SessionLog::Entries> log;

  bool operator==(const News&) const = default;
};

/// Whether `call` makes the line of a script before it needless: the same with other values, as of a slider.
bool replaces(const CommandCall& call, const std::string& line) {
  const Command& command = *call.command;
  if (call.arguments.empty() || command.arguments.front().kind != Argument::Kind::number || command.adds_up)
    return false;
  const CommandCall before = parse_call(line);
  return before.command == &command && before.arguments.size() == call.arguments.size();
}

}  // namespace

struct Interface::Parts {
  Parts(RenderSurface& s, SessionWorker& w, InspectionWorker& i, double scale)
      : surface(s), worker(w), inspector(i), host(scale), view(s, scale), pictures(&s), composer(s), layout(1, 1, 1) {}

  RenderSurface& surface;
  SessionWorker& worker;
  InspectionWorker& inspector;
  ImguiHost host;
  InputQueue queue;
  SceneView view;
  ScenePointer pointer;
  PanelPictures pictures;
  FrameComposer composer;
  AllPanels panels;
  Layout layout;
  Side layout_open = Side::right;  ///< that the layout was made for
  WindowState state;
  News news;
  std::uint64_t session = 0;                        ///< whose numbers the selection has
  std::shared_ptr<const SessionSnapshot> asked_of;  ///< the last question
  Selection asked;
  ScriptPlayer script;
  bool tooltip_is_due = false;  ///< in the last frame
  bool camera_moved = false;    ///< by a person, since it was framed
  double motion_left = 0;       ///< until the camera is at rest [s]; 0: it is
  bool scene_is_old = true;
  std::size_t scene_drawings = 0;
  int settling = frames_to_settle;

  News latest() const { return {worker.snapshot(), worker.progress(), inspector.answer(), worker.log().entries()}; }
  bool script_may_go_on() const;
  void take_news();
  void take_input();
  bool layout_is_old() const;
  void follow_size();
  void follow_session();
  void draw_interface(double seconds);
  void follow_tooltip();
  void do_calls(std::vector<CommandCall> calls);
  void do_call(const CommandCall& call);
  void follow_pointer(const PanelContext& context, double seconds);
  void move_camera();
  void bring_to_rest();
  void ask_inspector();
  bool draw_scene();
  void write_picture();
};

Interface::Interface(RenderSurface& surface, SessionWorker& worker, InspectionWorker& inspector, double scale) {
  surface.make_current();
  parts_ = std::make_unique<Parts>(surface, worker, inspector, scale);
  ImGui_ImplOpenGL3_Init("#version 150");
  parts_->news = parts_->latest();
}

Interface::~Interface() {
  parts_->surface.make_current();
  parts_->host.make_current();
  ImGui_ImplOpenGL3_Shutdown();
}

void Interface::set_clipboard(Clipboard clipboard) { parts_->host.set_clipboard(std::move(clipboard)); }
void Interface::push(const InputEvent& event) { parts_->queue.push(event); }
void Interface::open(const Configuration& configuration) {
  parts_->state.script = starting_script(configuration);
  parts_->worker.post(request::Load{configuration});
}
void Interface::run_script(std::vector<CommandCall> calls) { parts_->script.add(std::move(calls)); }
bool Interface::script_is_done() const { return parts_->script.done() || parts_->state.quit; }
ScriptPlayer& Interface::script() { return parts_->script; }
bool Interface::wants_to_quit() const { return parts_->state.quit && !parts_->state.picture_file; }
const Layout& Interface::layout() const { return parts_->layout; }
const WindowState& Interface::state() const { return parts_->state; }
SceneView& Interface::scene() { return parts_->view; }
std::size_t Interface::scene_drawings() const { return parts_->scene_drawings; }
std::size_t Interface::pixels_drawn() const { return parts_->composer.drawn().pixels(); }

double Interface::seconds_to_next_frame() const {
  const Parts& p = *parts_;
  if (p.settling > 0 || !p.queue.empty() || p.layout_is_old() || p.script_may_go_on() || !(p.news == p.latest()))
    return 0.0;
  double wait = std::min(seconds_to_tooltip(p.host.context()), p.panels.seconds_left());
  if (p.motion_left > 0) wait = std::min(wait, p.motion_left);
  return p.news.progress.busy ? std::min(wait, longest_wait_while_busy) : wait;
}

std::string Interface::title() const {
  const SessionSnapshot& s = *parts_->news.snapshot;
  if (!s.loaded()) return "Nextview";
  return fmt::format("Nextview - {} - view {} of {}", s.object_name, s.records.size(),
                     s.configuration.termination.views);
}

/// A script waits until nothing runs and the news of that are here.
bool Interface::Parts::script_may_go_on() const {
  const bool at_rest = (!news.progress.busy || news.progress.paused) && news == latest() && !inspector.busy() &&
                       !state.picture_file && !state.quit;
  return script.may_go_on({*news.snapshot, news.progress, state}, at_rest);
}

void Interface::Parts::take_news() {
  News now = latest();
  if (now.snapshot != news.snapshot || now.inspection != news.inspection || now.log != news.log ||
      now.progress.busy != news.progress.busy)
    settling = frames_to_settle;
  news = std::move(now);
}

void Interface::Parts::take_input() {
  const std::vector<InputEvent> events = queue.take_frame();
  if (!events.empty()) settling = frames_to_settle;
  host.take(events);
  for (const InputEvent& event : events) {
    if (std::holds_alternative<input::Expose>(event)) composer.forget();
    if (const auto* drop = std::get_if<input::Drop>(&event)) do_call(make_call("open", {drop->file.string()}));
  }
}

bool Interface::Parts::layout_is_old() const {
  return layout.width != surface.width() || layout.height != surface.height() || layout_open != state.open;
}

void Interface::Parts::follow_size() {
  if (!layout_is_old()) return;
  const Rectangle scene = layout.scene;
  const bool resized = layout.width != surface.width() || layout.height != surface.height();
  layout_open = state.open;
  layout = Layout(surface.width(), surface.height(), host.style().scale, state.open);
  settling = frames_to_settle;
  if (!resized && layout.scene == scene) return;
  view.place(layout.scene);
  if (!camera_moved) view.move(camera_motion::Frame{});
  scene_is_old = true;
}

/// Another session has other views, voxels and rays; after going back some of them are gone.
void Interface::Parts::follow_session() {
  const SessionSnapshot& s = *news.snapshot;
  if (session != s.session) {
    session = s.session;
    state.selection = {};
    camera_moved = false;
  }
  if (state.selection.view.kind == LookedAt::Kind::taken && state.selection.view.index >= s.records.size())
    state.selection.view = {};
}

void Interface::Parts::draw_interface(double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  host.begin_frame(int(layout.width), int(layout.height), seconds);
  std::vector<CommandCall> calls;
  std::optional<std::size_t> hovered;
  const PanelContext context{*news.snapshot, news.progress, state, *news.inspection, *news.log,
                             host.style(),   pictures,      calls, hovered};
  state.scene_camera = view.camera_pose();
  obey_keys(context);
  follow_pointer(context, seconds);
  panels.draw(context, layout, worker.log().count(), seconds);
  draw_selection_overlay(view, context);
  ImGui::Render();
  follow_tooltip();
  if (calls.empty() && script_may_go_on()) calls = script.go_on(*news.snapshot);
  do_calls(std::move(calls));
}

/// ImGui shows a window that is new a frame after it was made.
void Interface::Parts::follow_tooltip() {
  const bool due = nextview::tooltip_is_due(host.context());
  if (due && !tooltip_is_due) settling = frames_to_settle;
  tooltip_is_due = due;
}

void Interface::Parts::do_calls(std::vector<CommandCall> calls) {
  if (!calls.empty()) settling = frames_to_settle;
  for (const CommandCall& call : calls) do_call(call);
}

/// What cannot be done now is told in the log. Calls that only differ in their values (of a slider) are one line of the
/// script.
void Interface::Parts::do_call(const CommandCall& call) {
  CommandTarget target{worker, state, *news.snapshot, news.progress};
  try {
    execute(call, target);
  } catch (const std::exception& error) {
    script.refused(call, error.what());
    return worker.log().add(LogEntry::Level::warning, error.what());
  }
  if (call.command->name == "palette" || call.command->name == "shortcuts") return;
  if (!state.script.empty() && replaces(call, state.script.back())) state.script.pop_back();
  state.script.push_back(call.text());
}

void Interface::Parts::follow_pointer(const PanelContext& context, double seconds) {
  if (pointer.follow(view, context)) {
    camera_moved = scene_is_old = true;
    motion_left = rest;
    view.set_in_motion(true);
  } else if (motion_left > 0 && (motion_left -= seconds) <= 0) {
    bring_to_rest();
  }
}

void Interface::Parts::bring_to_rest() {
  motion_left = 0;
  view.set_in_motion(false);
  scene_is_old = true;
}

void Interface::Parts::move_camera() {
  for (const CameraMotion& motion : state.camera_motions) {
    view.move(motion);
    camera_moved = !std::holds_alternative<camera_motion::Frame>(motion);
    bring_to_rest();
  }
  state.camera_motions.clear();
}

void Interface::Parts::ask_inspector() {
  if (!news.snapshot->loaded() || (asked_of == news.snapshot && asked == state.selection)) return;
  asked_of = news.snapshot;
  asked = state.selection;
  inspector.ask(asked_of, asked);
}

/// Returns whether it was drawn anew.
bool Interface::Parts::draw_scene() {
  scene_is_old |= view.show(news.snapshot, state, news.inspection);
  if (!scene_is_old) return false;
  surface.render();
  ++scene_drawings;
  scene_is_old = false;
  return true;
}

/// Without what is in front of the panels; the back buffer then has the whole frame again.
void Interface::Parts::write_picture() {
  const std::string file = *std::exchange(state.picture_file, std::nullopt);
  PanelsAlone alone(*ImGui::GetDrawData());
  composer.compose(alone.data(), std::nullopt, false);
  composer.fill_back_buffer();
  const Image picture = surface.read_back();
  composer.compose(*ImGui::GetDrawData(), std::nullopt, false);
  composer.fill_back_buffer();
  try {
    write_png(picture, file);
    worker.log().add(LogEntry::Level::success, "Picture written to " + file);
  } catch (const std::exception& error) {
    const std::string reason = fmt::format("save-picture: {}", error.what());
    script.refused(make_call("save-picture", {file}), reason);
    worker.log().add(LogEntry::Level::warning, reason);
  }
}

bool Interface::draw(double seconds) {
  Parts& p = *parts_;
  p.host.make_current();
  p.surface.make_current();
  p.settling = std::max(p.settling - 1, 0);
  const bool wants_picture = p.state.picture_file.has_value();  // since a frame: what it was asked from is gone
  p.take_news();
  p.follow_session();
  p.take_input();
  p.follow_size();
  const std::size_t pictures = p.pictures.uploads();
  p.draw_interface(seconds);
  p.move_camera();
  p.ask_inspector();
  const auto new_scene = p.draw_scene() ? std::optional(p.layout.scene) : std::nullopt;
  const bool new_frame = p.composer.compose(*ImGui::GetDrawData(), new_scene, p.pictures.uploads() != pictures);
  if (wants_picture) p.write_picture();
  return new_frame || wants_picture;
}

}  // namespace nextview
