// What is written down of the window's work besides the commands that are given, so that it can be done again.
#include <algorithm>
#include <cmath>

#include "ui/commands/demo_commands.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/scanner_commands.hpp"
#include "ui/window/interface_parts.hpp"

namespace nextview {

/// While views are played, what is asked for is done behind the view that is under way, and is written down then.
/// Nothing is offered to who plays a script: it opens what was gone on with.
void Interface::Parts::record(const CommandCall& call, std::uint64_t request, bool playing) {
  if (call.command == &command::play) return;
  if (call.command == &command::answer && news.progress.answers == SessionWorker::offer_answers()) {
    if (call.values().front() == SessionWorker::offer_answers().front())
      recorder.add(command::open(std::filesystem::absolute(offered).string()), offer_request);
    return;
  }
  if (playing && request > 0)
    behind_play.emplace_back(request, call);
  else
    recorder.add(call, request);
}

/// Each view that was played is a step: how many they are depends on when somebody paused.
void Interface::Parts::record_done() {
  for (const auto& [request, failed] : worker.take_done()) {
    const auto given = std::ranges::find(behind_play, request, &std::pair<std::uint64_t, CommandCall>::first);
    if (request == 0) {
      recorder.add(command::step());
      state.history.now += worker.progress().pause_between_views;
    } else if (given != behind_play.end()) {
      if (!failed) recorder.add(given->second, request);
      behind_play.erase(given);
    } else if (failed) {
      recorder.forget(request);
    }
  }
  if (!worker.progress().busy) behind_play.clear();  // what is left was dropped by a later request
}

/// Where the operator has brought the camera to, in as much time as that took.
void Interface::Parts::record_drag() {
  if (!state.recording) return;
  const CameraFlight flight = CameraCourse::flight_to_here(view);
  const double seconds = std::max(std::round(100 * (state.history.now - motion_began)) / 100, 0.1);
  const Vector3& focus = *flight.focus;
  recorder.add(command::fly_to(flight.azimuth, flight.elevation, seconds, flight.zoom, focus.x(), focus.y(), focus.z()),
               0, seconds);
}

}  // namespace nextview
