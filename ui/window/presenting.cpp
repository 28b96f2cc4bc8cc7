// A demo in the window: its time, its camera, and who has the keyboard meanwhile.
#include "ui/window/interface_parts.hpp"

namespace nextview {

/// Nothing runs, and what came of it is here.
bool Interface::Parts::at_rest() const {
  return (!news.progress.busy || news.progress.paused) && news == latest() && !inspector.busy() && !state.picture &&
         !state.quit;
}

/// What the session takes to compute is not the demo's time.
void Interface::Parts::pass_time(double seconds) {
  Presentation& p = state.presentation;
  const bool rests = at_rest();
  const double passed = p.pass(rests && rested ? seconds : 0.0, !script.done());
  rested = rests;
  fly(passed);
  if (p.demo && script.done()) p = {};
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

/// Space pauses, Right skips what is waited for, and whatever else is done takes over. What a demo shows depends on no
/// pointer. Returns what is left for the window.
std::vector<InputEvent> Interface::Parts::input_beside_demo(const std::vector<InputEvent>& events) {
  std::vector<InputEvent> left;
  Presentation& p = state.presentation;
  for (const InputEvent& event : events) {
    const auto* key = std::get_if<input::KeyChange>(&event);
    const auto* button = std::get_if<input::Button>(&event);
    if (!p.demo || std::holds_alternative<input::Expose>(event) || (key && !key->down))
      left.push_back(event);
    else if (key && key->key == Key::space)
      p.paused = !p.paused;
    else if (key && key->key == Key::right)
      p.due += p.hold;
    else if (key || (button && button->down) || std::holds_alternative<input::Drop>(event))
      take_over();
  }
  return left;
}

void Interface::Parts::take_over() {
  script.stop();
  state.presentation = {};
  course.reset();
  state.panels_hidden = false;
}

}  // namespace nextview
