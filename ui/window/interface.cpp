#include "ui/window/interface.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/commands/command_target.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/window/interface_parts.hpp"

namespace nextview {
namespace {

/// The remaining time of a job is told in whole seconds.
constexpr double longest_wait_while_busy = 1.0;
/// Of what moves by itself [s].
constexpr double frame_time = 1.0 / 60;
/// How often it is asked whether what the scene waits for is there [s].
constexpr double scene_wait = 0.003;

/// Whether nothing differs but how far what runs has come.
bool differ_in_progress_alone(const News& before, const News& now) {
  const bool runs = now.progress.busy && !now.progress.paused;
  if (!runs && !now.surface_progress) return false;
  News as_far = before;
  if (runs) {
    as_far.progress.fraction = now.progress.fraction;
    as_far.progress.what = now.progress.what;
    as_far.progress.seconds_left = now.progress.seconds_left;
    as_far.progress.sampler = now.progress.sampler;
  }
  if (as_far.surface_progress && now.surface_progress) as_far.surface_progress = now.surface_progress;
  return as_far == now;
}

}  // namespace

Interface::Interface(RenderTarget& target, SessionWorker& worker, InspectionWorker& inspector, double scale) {
  target.make_current();
  parts_ = std::make_unique<Parts>(target, worker, inspector, scale);
  ImGui_ImplOpenGL3_Init("#version 150");
  parts_->news = parts_->latest();
}

Interface::~Interface() {
  parts_->target.make_current();
  parts_->host.make_current();
  ImGui_ImplOpenGL3_Shutdown();
}

void Interface::renew_target() {
  Parts& p = *parts_;
  p.target.make_current();
  p.host.make_current();
  p.pictures.forget();
  p.composer.forget();
  ImGui_ImplOpenGL3_Shutdown();
  p.target.renew();
  ImGui_ImplOpenGL3_Init("#version 150");
  p.scene_is_old = true;
  p.settling = frames_to_settle;
  p.worker.log().add(LogEntry::Level::note, "The graphics driver lost what was drawn: it was made again");
}

void Interface::set_clipboard(Clipboard clipboard) { parts_->host.set_clipboard(std::move(clipboard)); }
void Interface::push(const InputEvent& event) { parts_->queue.push(event); }
void Interface::open(const Configuration& configuration) {
  parts_->recorder.begin(configuration);
  parts_->worker.post(request::Load{configuration});
}
void Interface::open_session(const std::filesystem::path& folder) {
  parts_->recorder.begin_with(folder);
  parts_->worker.post(request::OpenFile{folder});
}
void Interface::connect(const request::Connect& scanner) {
  parts_->recorder.begin(*scanner.configuration);
  parts_->worker.post(scanner);
}
void Interface::offer(const EarlierSession& session) {
  parts_->offered = session.folder;
  parts_->worker.post(request::OfferSession{session});
  parts_->offer_request = parts_->worker.posted();
}
void Interface::run_script(std::vector<CommandCall> calls) { parts_->script.add(std::move(calls)); }
void Interface::record(const std::string& file) {
  CommandTarget target{parts_->worker, parts_->state, *parts_->news.snapshot, parts_->news.progress};
  execute(command::record(file), target);
}
void Interface::stop_recording() {
  CommandTarget target{parts_->worker, parts_->state, *parts_->news.snapshot, parts_->news.progress};
  if (parts_->state.recording) execute(command::record_stop(), target);
}
void Interface::play_demo(std::vector<CommandCall> calls) { parts_->begin_demo(std::move(calls)); }
bool Interface::script_is_done() const { return parts_->script.done() || parts_->state.quit; }
ScriptPlayer& Interface::script() { return parts_->script; }
void Interface::ask_to_quit() {
  Parts& p = *parts_;
  if (p.asked_call.waiting_for(command::quit)) p.state.quit = true;
  ask(command::quit());
}
void Interface::ask(const CommandCall& call) {
  parts_->do_for_people(call);
  parts_->settling = frames_to_settle;
}
std::string Interface::question() const { return parts_->asked_call.with_question(parts_->worker.progress()).question; }
bool Interface::wants_to_quit() const {
  const auto& picture = parts_->state.picture;  // that is asked for is still drawn, but for a turntable's many
  return parts_->state.quit && (!picture || picture->of == PictureRequest::Of::turntable);
}
void Interface::set_preferences(const WindowPreferences& wanted) {
  WindowState& state = parts_->state;
  state.text_scale = wanted.text_scale;
  state.guide_open = wanted.guide;
  state.dark = wanted.dark;
  state.place_sizes = wanted.place_sizes;
}
WindowPreferences Interface::preferences() const {
  const WindowState& own = parts_->state.presentation.demo ? parts_->before_demo : parts_->state;
  return {own.text_scale, own.guide_open, own.dark, own.place_sizes};
}
void Interface::show_guide(bool show) { parts_->state.guide_open = show; }
void Interface::set_last_session(std::optional<EarlierSession> session) {
  parts_->state.last_session = std::move(session);
}
const Layout& Interface::layout() const { return parts_->layout; }
const WindowState& Interface::state() const { return parts_->state; }
SceneView& Interface::scene() { return parts_->view; }
std::size_t Interface::scene_drawings() const { return parts_->scene_drawings; }
std::size_t Interface::pixels_drawn() const { return parts_->composer.drawn().pixels(); }

double Interface::seconds_to_next_frame() const {
  const Parts& p = *parts_;
  const News latest = p.latest();
  const bool has_news = !(p.news == latest), goes_on = has_news && differ_in_progress_alone(p.news, latest);
  if (p.settling > 0 || p.state.picture || !p.queue.empty() || p.layout_is_old() || p.script_may_go_on() ||
      (has_news && !goes_on))
    return 0.0;
  const Presentation& shown = p.state.presentation;
  const bool time_passes = shown.is_moving() && !shown.paused && p.at_rest();
  if (time_passes && (!p.rested || (shown.due > 0 && shown.holds()))) return 0.0;
  double wait = std::min(seconds_to_tooltip(p.host.context()), p.panels.seconds_left());
  // How far something has come is told as often as a display shows it, not each time that it is a little farther.
  if (time_passes || goes_on || (shown.demo && p.script.done())) wait = std::min(wait, frame_time);
  if (p.scene_waits) wait = std::min(wait, scene_wait);
  if (p.motion_left > 0) wait = std::min(wait, p.motion_left);
  return p.news.progress.busy ? std::min(wait, longest_wait_while_busy) : wait;
}

// What runs is asked first: it may end meanwhile, and then there is something to draw.
bool Interface::is_still() const { return !parts_->works() && !parts_->scene_waits && seconds_to_next_frame() > 0.0; }
bool Interface::is_drawn_well() const { return parts_->motion_left <= 0; }

std::string Interface::title() const {
  const SessionSnapshot& s = *parts_->news.snapshot;
  if (!s.loaded()) return "Nextview";
  const TerminationConfig& end = s.configuration.termination;
  const std::string of = end.limits_views(s.records.size()) ? fmt::format(" of {}", end.views) : "";
  return fmt::format("Nextview - {} - view {}{}", s.object_name, s.records.size(), of);
}

bool Interface::draw(double seconds) {
  Parts& p = *parts_;
  p.host.make_current();
  p.target.make_current();
  p.settling = std::max(p.settling - 1, 0);
  const bool wants_picture = p.state.picture.has_value();  // since a frame: what it was asked from is gone
  p.take_picture_size();
  const bool for_picture_alone = p.size_before.has_value();
  p.take_news();
  p.follow_session();
  p.take_input();
  p.follow_scale();
  p.follow_size();
  p.share_scene();
  p.pass_time(seconds);
  const std::size_t pictures = p.pictures.uploads();
  p.draw_interface(seconds);
  p.move_camera();
  p.ask_inspector();
  p.ask_surface();
  if (wants_picture) p.draw_wanted_picture();
  const auto new_scene = p.draw_scene() ? std::optional(p.layout.scene) : std::nullopt;
  const bool new_frame = p.composer.compose(*ImGui::GetDrawData(), new_scene, p.pictures.uploads() != pictures);
  if (wants_picture) p.write_window_picture();
  return !for_picture_alone && (new_frame || wants_picture);
}

}  // namespace nextview
