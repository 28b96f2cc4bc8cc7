// A demo in the window: its time, its camera, and who has the keyboard meanwhile.
#include <algorithm>
#include <utility>

#include "ui/commands/demo_commands.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/commands/scene_commands.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/window/interface_parts.hpp"

namespace nextview {
namespace {

/// A modifier alone is nothing yet, and comes with what a desktop does: another window, a picture of this one.
bool leaves_demo_alone(Key key) {
  return key == Key::f12 || key == Key::control || key == Key::shift || key == Key::alt;
}

}  // namespace

bool Interface::Parts::works() const {
  const WorkerProgress now = worker.progress();
  return (now.busy && !now.paused) || inspector.busy();
}

/// Nothing runs, and what came of it is here: asked in this order, as it may end in between.
bool Interface::Parts::at_rest() const { return !works() && news == latest() && !state.picture && !state.quit; }

/// What the session takes to compute is not the demo's time.
void Interface::Parts::pass_time(double seconds) {
  Presentation& p = state.presentation;
  const bool rests = at_rest();
  if (rests && rested && script.done()) state.history.now += seconds;
  const double passed = p.pass(rests && rested ? seconds : 0.0, !script.done());
  rested = rests;
  fly(passed);
  if (p.demo && script.done()) take_over();
}

void Interface::Parts::fly(double seconds) {
  auto& flights = state.presentation.flights;
  while (!flights.empty() && (seconds > 0 || flights.front().seconds <= 0)) {
    CameraFlight& flight = flights.front();
    if (!course) course.emplace(view, flight);
    const double now = std::min(seconds, flight.seconds - flight.elapsed);
    flight.elapsed += now;
    seconds -= now;
    const double left = flight.seconds - flight.elapsed;
    course->stand(view, left > 1e-9 ? eased(flight.elapsed / flight.seconds) : 1.0);
    camera_moved = scene_is_old = true;
    if (left > 1e-9) return;
    flights.pop_front();
    course.reset();
  }
}

/// Space pauses, Right skips what is waited for, F12 is the full screen, and whatever else is done takes over; a file
/// that is dropped is opened, too. What a demo shows depends on no pointer. Returns what is left for the window.
std::vector<InputEvent> Interface::Parts::input_beside_demo(const std::vector<InputEvent>& events) {
  std::vector<InputEvent> left;
  Presentation& p = state.presentation;
  for (const InputEvent& event : events) {
    const auto* key = std::get_if<input::KeyChange>(&event);
    const auto* button = std::get_if<input::Button>(&event);
    if (p.demo && std::holds_alternative<input::Drop>(event)) take_over();
    if (!p.demo || std::holds_alternative<input::Expose>(event) || (key && (!key->down || leaves_demo_alone(key->key))))
      left.push_back(event);
    else if (key && key->key == Key::space)
      p.paused = !p.paused;
    else if (key && key->key == Key::right)
      p.due += p.hold;
    else if (key || (button && button->down))
      take_over();
  }
  return left;
}

/// With the window as it is at first, whatever its user likes.
void Interface::Parts::begin_demo(std::vector<CommandCall> calls) {
  if (motion_left > 0) bring_to_rest();
  before_demo = std::exchange(state, {});
  state.history = before_demo.history;
  state.text_scale = before_demo.text_scale;
  state.full_screen = before_demo.full_screen;
  state.guide_open = false;
  state.presentation.demo = true;
  state.presentation.captioned =
      std::ranges::any_of(calls, [](const CommandCall& call) { return call.command == &command::caption; });
  script.add(std::move(calls));
}

/// What is the user's own, and kept for the next start, comes back. What a recording can say, it is told.
void Interface::Parts::give_back() {
  state.text_scale = before_demo.text_scale;
  state.guide_open = before_demo.guide_open;
  state.last_session = before_demo.last_session;
  if (state.dark != before_demo.dark) do_call(command::dark());
  if (state.orthographic != before_demo.orthographic) do_call(command::toggle_orthographic());
  const auto& [left, right, lower] = before_demo.place_sizes;
  if (state.place_sizes != before_demo.place_sizes) do_call(command::panel_sizes(left, right, lower));
}

/// What a demo leaves away comes back by commands, as a recording needs them, too; also where it ends by itself.
void Interface::Parts::take_over() {
  script.stop();
  state.presentation = {};
  course.reset();
  layers_are_of_demo = true;
  give_back();
  if (state.panels_hidden) do_call(command::hide_panels());
  if (!state.layers.legends) do_call(command::toggle_legends());
  if (!state.layers.views) do_call(command::toggle_views());
  if (!state.layers.rays) do_call(command::toggle_rays());
}

/// What a demo ended with stays in sight as long as its object is there; who opens the next one has the
/// layers from before it.
void Interface::Parts::leave_layers_of_demo() {
  const LayerChoice& usual = before_demo.layers;
  const LayerChoice& now = state.layers;
  const auto set_back = [&](const CommandOf<>& toggle, bool LayerChoice::*shown) {
    if (now.*shown != usual.*shown) do_call(toggle());
  };
  set_back(command::toggle_missed, &LayerChoice::missed);  // these two switch others
  set_back(command::toggle_surface, &LayerChoice::surface);
  set_back(command::toggle_object, &LayerChoice::object);
  set_back(command::toggle_octree, &LayerChoice::octree);
  set_back(command::toggle_cloud, &LayerChoice::cloud);
  set_back(command::toggle_candidates, &LayerChoice::all_candidates);
  if (now.object_style != usual.object_style) do_call(command::object_style(usual.object_style));
  if (now.cloud_colouring != usual.cloud_colouring) do_call(command::cloud_colour(usual.cloud_colouring));
  if (now.map != usual.map) do_call(command::voxel_map(usual.map));
  if (now.colouring != usual.colouring) do_call(command::voxel_colour(usual.colouring));
}

/// From nothing: with the window and the settings as they are at first.
void Interface::Parts::play(const std::string& demo) {
  std::vector<CommandCall> calls = read_demo(demo).calls;
  if (news.snapshot->loaded()) {
    Configuration configuration;
    configuration.object = news.snapshot->configuration.object;
    worker.post(request::Load{configuration});
  }
  recorder.begin_with_nothing();
  course.reset();
  layers_are_of_demo = false;
  script.stop();
  begin_demo(std::move(calls));
}

}  // namespace nextview
