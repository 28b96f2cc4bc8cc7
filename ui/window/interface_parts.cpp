#include "ui/window/interface_parts.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "ui/commands/command_target.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/scanner_commands.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/window/presentation_drawing.hpp"
#include "ui/window/selection_overlay.hpp"

namespace nextview {
/// A script waits until nothing runs and the news of that are here.
bool Interface::Parts::script_may_go_on() const {
  if (state.presentation.holds() || state.presentation.paused) return false;
  return script.may_go_on({*news.snapshot, progress(), state}, at_rest());
}

void Interface::Parts::take_news() {
  record_done();
  News now = latest();
  if (now.snapshot != news.snapshot || now.inspection != news.inspection || now.log != news.log ||
      now.surface != news.surface || now.surface_progress != news.surface_progress ||
      now.progress.busy != news.progress.busy || now.progress.question != news.progress.question ||
      now.progress.question_number != news.progress.question_number)
    settling = frames_to_settle;
  // The panels tell of a new map first, and the scene a frame later: both in one would hold up the hand.
  const bool new_map = now.snapshot->session == news.snapshot->session && now.snapshot->map != news.snapshot->map;
  if (new_map && by_hand() && view.shows(*news.snapshot)) {
    scene_waits = true;
    if (state.layers.octree) faces.ask({now.snapshot, state.layers.map, state.layers.shown_voxels()});
  }
  news = std::move(now);
}

void Interface::Parts::take_input() {
  const std::vector<InputEvent> events = input_beside_demo(queue.take_frame());
  if (!events.empty()) settling = frames_to_settle;
  host.take(events);
  for (const InputEvent& event : events) {
    if (std::holds_alternative<input::Expose>(event)) composer.forget();
    if (const auto* drop = std::get_if<input::Drop>(&event)) {
      do_for_people(command::open(drop->file.string()));
      if (drop->count > 1)  // once it opens: what was said before is of the object before
        worker.log().add(LogEntry::Level::warning, fmt::format("{} files were dropped: one is opened, {}", drop->count,
                                                               drop->file.filename().string()));
    }
  }
}

/// As large as its user wants text, but where the control bar would have no room any more.
double Interface::Parts::scale() const {
  const double largest = Layout::largest_scale(target.width(), target.height());
  return std::min(display_scale * state.text_scale, std::max(display_scale, largest));
}

void Interface::Parts::follow_scale() {
  const double wanted = scale();
  host.set_dark(state.dark);
  if (float(wanted) == host.style().scale) return;
  host.set_scale(wanted);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  view.set_scale(wanted);
  compared.set_scale(wanted);
  layout.width = 0;  // it is old
  scene_is_old = true;
}

bool Interface::Parts::layout_is_old() const {
  return float(scale()) != host.style().scale || layout_hidden != state.panels_hidden ||
         layout.captions.empty() == shows_captions() || layout.width != target.width() ||
         layout.height != target.height() || layout_open != state.open || layout_sizes != state.place_sizes;
}

void Interface::Parts::follow_size() {
  if (!layout_is_old()) return;
  const Rectangle scene = layout.scene;
  const bool resized = layout.width != target.width() || layout.height != target.height();
  layout_open = state.open;
  layout_sizes = state.place_sizes;
  layout_hidden = state.panels_hidden;
  layout = shows_captions()
               ? Layout::with_captions(target.width(), target.height(), host.style().scale, state.open, layout_sizes)
               : Layout(target.width(), target.height(), host.style().scale, state.open, layout_sizes);
  if (layout_hidden) layout.hide_panels(state.presentation.demo);
  settling = frames_to_settle;
  if (resized || layout.scene != scene) view.place({});  // share_scene() gives it its place
}

/// The scene's place is the session's, or half of it while it is compared.
void Interface::Parts::share_scene() {
  const Rectangle before = view.rectangle();
  if (!compared.share(view, layout.scene, news.snapshot, state)) return;
  const Rectangle& now = view.rectangle();
  if (now != before && !camera_moved) view.move(framing);
  if (camera_moved && now.width < before.width) view.keep_in_sight(before.width / now.width);
  scene_is_old = true;
}

/// Another session has other views, voxels and rays; after going back, or by other settings, some of them are gone.
void Interface::Parts::follow_session() {
  const SessionSnapshot& s = *news.snapshot;
  if (session != s.session) {
    session = s.session;
    state.selection = {};
    camera_moved = false;
    framing = camera_motion::Frame{};
    if (std::exchange(layers_are_of_demo, false)) leave_layers_of_demo();
    if (std::exchange(object, s.object_name) != s.object_name) {  // what was cut there may not even be here
      state.layers.section.reset();
      state.layers.voxels.slice.reset();
    }
  }
  state.layers.follow_comparison(s.compared != nullptr);
  ViewSelection& selected = state.selection.view;
  const bool is_gone = (selected.kind == ViewSelection::Kind::taken && selected.index >= s.records.size()) ||
                       (selected.kind == ViewSelection::Kind::candidate && selected.index >= s.candidates.size());
  if (is_gone) selected = {};
}

void Interface::Parts::draw_interface(double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  host.begin_frame(int(layout.width), int(layout.height), seconds);
  std::vector<CommandCall> calls;
  std::optional<std::size_t> hovered;
  const WorkerProgress shown = asked_call.with_question(progress());
  const PanelContext context{*news.snapshot, shown, state,   *news.inspection,   *news.log.entries,    host.style(),
                             pictures,       calls, hovered, news.surface.get(), news.surface_progress};
  state.scene_camera = view.camera_pose();
  point_at(ImGui::GetIO().MousePos);
  panels.obey_keys(context);
  follow_pointer(context, seconds);
  panels.draw(context, layout, news.log.count, seconds);
  splitters.draw(context, layout);
  if (!news.progress.doubtful) {
    draw_selection_overlay(view, context);
    pointer.region_handles().draw(view, context);
    if (const Rectangle* const r = compared.rectangle())
      ImGui::GetBackgroundDrawList()->AddLine({float(r->x), float(r->y)}, {float(r->x), float(r->y + r->height)},
                                              to_imgui_u32(theme::hairline), host.style().px(2));
  }
  draw_presentation(host.style(), state.presentation, layout);
  ImGui::Render();
  follow_tooltip();
  scripted = calls.empty() && script_may_go_on();
  if (scripted) calls = script.go_on(*news.snapshot);
  do_calls(std::move(calls));
}

/// While the camera moves, the coordinates stay, and as long as neither pointer nor picture changes: all points are
/// looked at for them. In a demo nobody points.
void Interface::Parts::point_at(const ImVec2& mouse) {
  const bool over_scene = !ImGui::GetIO().WantCaptureMouse && view.rectangle().contains(mouse.x, mouse.y);
  if (!over_scene || state.presentation.demo) {
    pointed_from.reset();
    return state.pointed_at.reset();
  }
  const std::tuple now(mouse.x, mouse.y, scene_drawings);
  if (motion_left > 0 || std::exchange(pointed_from, now) == now) return;
  state.pointed_at = view.surface_point(mouse.x, mouse.y);
}

/// ImGui shows a window that is new a frame after it was made.
void Interface::Parts::follow_tooltip() {
  const bool due = nextview::tooltip_is_due(host.context());
  if (due && !tooltip_is_due) settling = frames_to_settle;
  tooltip_is_due = due;
}

void Interface::Parts::do_calls(std::vector<CommandCall> calls) {
  if (calls.empty()) return;
  settling = frames_to_settle;
  for (const CommandCall& call : calls) do_for_people(call);
  state.dismissed_failure = news.snapshot->failures;  // what failed before is no news once something else is done
}

/// Asks before what costs something; a script's calls are done as they are.
void Interface::Parts::do_for_people(const CommandCall& call) {
  if (asked_call.waiting() && news.progress.question.empty() && call.command == &command::answer) {
    if (const auto wanted = asked_call.answered(call.values().front())) do_call(*wanted);
  } else if (!asked_call.asks(call, {*news.snapshot, news.progress, state})) {
    do_call(call);
  }
}

/// What cannot be done now is told in the log.
void Interface::Parts::do_call(const CommandCall& wanted) {
  const WorkerProgress now = progress();
  CommandTarget acted_on{worker, state, *news.snapshot, now};
  const Selection before = state.selection;
  const CommandCall call = with_numbers(wanted, acted_on);
  const std::uint64_t posted = worker.posted();
  try {
    execute(call, acted_on);
    if (before != state.selection && call.command->menu == "Select")
      state.selections.push(before, {news.snapshot->session, news.snapshot->change});
  } catch (const std::exception& error) {
    script.refused(call, error.what());
    return worker.log().add(LogEntry::Level::warning, error.what());
  }
  record(call, worker.posted() > posted ? worker.posted() : 0, now.playing);
  if (!state.wanted_demo.empty()) play(std::exchange(state.wanted_demo, {}));
}

void Interface::Parts::ask_inspector() {
  if (!news.snapshot->loaded() || (asked_of == news.snapshot && asked == state.selection)) return;
  asked_of = news.snapshot;
  asked = state.selection;
  inspector.ask(asked_of, asked);
}

/// A surface that is shown is made of all views; it takes a moment, so none is made that nobody looks at.
void Interface::Parts::ask_surface() {
  const LayerChoice& layers = state.layers;
  if (!news.snapshot->loaded() || !(layers.surface || layers.second == SecondView::surface)) {
    if (asked_surface && inspector.surface_progress()) {
      inspector.drop_surface();
      asked_surface.reset();
    }
    return;
  }
  SurfaceQuestion question{news.snapshot, layers.surface_source, layers.map};
  if (asked_surface && asked_surface->same_as(question)) return;
  asked_surface = question;
  inspector.ask_surface(question);
}

}  // namespace nextview
