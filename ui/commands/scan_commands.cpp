#include "ui/commands/scan_commands.hpp"

#include <algorithm>
#include <stdexcept>

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

std::vector<std::string> available_candidates(const SessionSnapshot& s) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < s.candidates.size(); ++i)
    if (s.available(i)) result.push_back(std::to_string(i));
  return result;
}

std::string needs_more_to_scan(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  if (t.session.finished.empty()) return "";
  const char* const way_out = available_candidates(t.session).empty() ? "" : "; Continue takes more views";
  return "the scan is finished: " + t.session.finished + way_out;
}

std::string step_why_not(const CommandState& t) {
  return t.progress.playing ? "views are being taken already" : needs_more_to_scan(t);
}

/// A scan that is finished goes on for a view that a person wants.
std::string take_why_not(const CommandState& t) {
  if (const std::string reason = needs_view(t); !reason.empty()) return reason;
  const bool is_over = !t.session.finished.empty() && available_candidates(t.session).empty();
  return is_over ? needs_more_to_scan(t) : needs_rest(t);
}

std::string take_proposal_why_not(const CommandState& t) {
  if (const std::string reason = take_why_not(t); !reason.empty()) return reason;
  if (const std::string reason = needs_more_to_scan(t); !reason.empty()) return reason;
  if (!t.session.proposal()) return "no candidate is left";
  return t.session.next_candidate == t.session.proposal() ? "it is the next view" : "";
}

std::string take_custom_view_why_not(const CommandState& t) {
  if (const std::string reason = take_why_not(t); !reason.empty()) return reason;
  return t.window.selection.custom_view ? "" : "set up a custom view first (custom-view)";
}

std::string continue_why_not(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  if (t.session.finished.empty()) return "the scan is not finished";
  return available_candidates(t.session).empty() ? "no candidate view is left" : "";
}

SelectionHistory::Moment moment(const CommandState& t) { return {t.session.session, t.session.change}; }

/// What an opened session came with is gone along in the timeline.
std::string undo_why_not(const CommandState& t) {
  if (t.window.selections.can_undo(moment(t))) return "";
  if (t.session.can_undo) return needs_rest(t);
  return t.session.records.empty() ? "there is nothing to undo"
                                   : "nothing was done since this was opened; Page Up goes back along its views";
}

/// Lifts what ends the scan, for some more views.
void go_beyond_limits(CommandTarget& t) {
  TerminationConfig beyond = TerminationConfig::unlimited();
  const int allowed = t.session.configuration.termination.views, more = TerminationConfig().views;
  beyond.views = std::max(allowed, std::min(int(t.session.records.size()) + more, TerminationConfig::max_views));
  t.worker.post(request::SetTermination{beyond});
}

void look_at_next_view(WindowState& window) {
  window.selection.view = {};
  window.selection.ray.reset();
}

void take(CommandTarget& t, std::optional<std::size_t> candidate) {
  if (!candidate) candidate = t.window.selection.candidate();
  if (!candidate) throw std::invalid_argument("take-view: select a candidate first, or name one");
  if (!t.session.available(*candidate))
    throw std::invalid_argument("take-view: view " + std::to_string(*candidate) + " is not available");
  if (!t.session.finished.empty()) go_beyond_limits(t);
  t.worker.post(request::TakeView{*candidate});
  look_at_next_view(t.window);
}

void take_own(CommandTarget& t) {
  if (!t.session.finished.empty()) go_beyond_limits(t);
  t.worker.post(request::TakeCustomView{*t.window.selection.custom_view});
  look_at_next_view(t.window);
}

}  // namespace

const CommandOf<> command::step{{"step",
                                 "Scan",
                                 "Take the next view",
                                 "Takes the next view: measures, updates the map, ranks the candidates.",
                                 {{key('S')}, {Key::space}},
                                 step_why_not},
                                [](CommandTarget& t) { t.worker.post(request::Step{}); }};

const CommandOf<> command::play{
    {"play", "Scan", "Play", "Takes views until the scan is finished or paused.", {{key('P')}}, step_why_not},
    [](CommandTarget& t) { t.worker.post(request::Play{}); }};

const CommandOf<> command::go_on{
    {"continue",
     "Scan",
     "Continue beyond the limits",
     "Lets a finished scan go on from where it is: lifts what ends it (termination.*), for 20 more views, and takes "
     "the next one.",
     {},
     continue_why_not},
    [](CommandTarget& t) {
      go_beyond_limits(t);
      t.worker.post(request::Step{.with_last = true});
    }};

const CommandOf<> command::pause{
    {"pause",
     "Scan",
     "Pause",
     "Stops taking views after the one that is under way.",
     {{key('P')}},
     [](const CommandState& t) { return t.progress.playing ? "" : "no views are being taken"; }},
    [](CommandTarget& t) { t.worker.post(request::Pause{}); }};

const CommandOf<double> command::speed{
    {"speed", "Scan", "Pause between views…", "How long Play waits between two views."},
    argument::number("seconds", "from one view to the next [s]", 0, 60),
    [](CommandTarget& t, double seconds) { t.worker.set_pause_between_views(seconds); }};

const CommandOf<std::optional<std::size_t>> command::take_view{
    {"take-view",
     "Scan",
     "Take this candidate next…",
     "Makes a candidate, or the selected one, the next view instead of the proposal. A finished scan goes on, as by "
     "continue.",
     {{key('T')}},
     take_why_not},
    argument::optional(argument::whole("candidate", "its number", 0, 1e6, available_candidates)),
    take};

const CommandOf<> command::take_proposal{
    {"take-proposal",
     "Scan",
     "Take the proposal after all",
     "Makes the planner's proposal the next view again.",
     {},
     take_proposal_why_not},
    [](CommandTarget& t) { t.worker.post(request::TakeView{*t.session.proposal()}); }};

const CommandOf<> command::take_custom_view{{"take-custom-view",
                                             "Scan",
                                             "Take the custom view next",
                                             "Makes the view that was set up with custom-view the next one.",
                                             {{key('T'), true}},
                                             take_custom_view_why_not},
                                            take_own};

const CommandOf<> command::cancel{{"cancel",
                                   "Scan",
                                   "Cancel what runs",
                                   "Stops what runs; a view that is not complete is not taken.",
                                   {{Key::escape}},
                                   [](const CommandState& t) { return t.progress.busy ? "" : "nothing runs"; }},
                                  [](CommandTarget& t) {
                                    t.worker.cancel();
                                    t.window.picture.reset();
                                  }};

const CommandOf<> command::undo{
    {"undo",
     "Scan",
     "Undo",
     "Goes back to before the last view, choice of one, selection, branch, or change of settings or object.",
     {{key('Z'), true}},
     undo_why_not},
    [](CommandTarget& t) {
      WindowState& w = t.window;
      if (w.selections.can_undo(moment(t.state())))
        w.selection = w.selections.undo(w.selection);
      else
        t.worker.post(request::Undo{});
    }};

const CommandOf<> command::redo{{"redo",
                                 "Scan",
                                 "Redo",
                                 "Does again what was undone.",
                                 {{key('Y'), true}, {key('Z'), true, {}, true}},
                                 [](const CommandState& t) {
                                   if (t.window.selections.can_redo(moment(t))) return std::string();
                                   return t.session.can_redo ? needs_rest(t) : "there is nothing to redo";
                                 }},
                                [](CommandTarget& t) {
                                  WindowState& w = t.window;
                                  if (w.selections.can_redo(moment(t.state())))
                                    w.selection = w.selections.redo(w.selection);
                                  else
                                    t.worker.post(request::Redo{});
                                }};

const CommandOf<> command::reset{{"reset",
                                  "Scan",
                                  "Start over",
                                  "Starts the scan over, with the same object and settings.",
                                  {{key('R')}},
                                  needs_session,
                                  {},
                                  false,
                                  [](const CommandState& t, const auto&) { return restart_question(t, "This"); }},
                                 [](CommandTarget& t) { t.worker.post(request::Reset{}); }};

}  // namespace nextview
