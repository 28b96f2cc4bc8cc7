#include "ui/window/command_list.hpp"

namespace nextview {
namespace {

std::string needs_more_to_scan(const CommandState& t) {
  if (!t.session.loaded()) return "there is no object yet";
  return t.session.finished.empty() ? "" : "the scan is finished: " + t.session.finished;
}

std::string step_why_not(const CommandState& t) {
  return t.progress.playing ? "views are being taken already" : needs_more_to_scan(t);
}

std::string take_why_not(const CommandState& t) {
  if (const std::string reason = needs_view(t); !reason.empty()) return reason;
  if (const std::string reason = needs_more_to_scan(t); !reason.empty()) return reason;
  return needs_rest(t);
}

std::vector<std::string> available_candidates(const SessionSnapshot& s) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < s.candidates.size(); ++i)
    if (s.available(i)) result.push_back(std::to_string(i));
  return result;
}

void take_view(CommandTarget& t, const Arguments& a) {
  const auto candidate = a.count() > 0 ? std::optional(a.whole(0)) : t.window.selection.candidate();
  if (!candidate) throw std::invalid_argument("take-view: select a candidate first, or name one");
  if (!t.session.available(*candidate))
    throw std::invalid_argument("take-view: view " + std::to_string(*candidate) + " is not available");
  t.worker.post(request::TakeView{*candidate});
  t.window.selection.view = {};
  t.window.selection.ray.reset();
}

void take_own_view(CommandTarget& t, const Arguments&) {
  t.worker.post(request::TakeOwnView{*t.window.selection.own_view});
  t.window.selection.view = {};
  t.window.selection.ray.reset();
}

/// A whole number, as a setting takes it.
Argument like_setting(const std::string& name, const std::string& key) {
  Configuration defaults;
  auto all = settings(defaults);
  const Setting& setting = find_setting(all, key);
  return {name, Argument::Kind::whole, setting.help, setting.bounds->low, setting.bounds->high, {}, true};
}

}  // namespace

std::string needs_session(const CommandState& t) { return t.session.loaded() ? "" : "there is no object yet"; }

std::string needs_view(const CommandState& t) {
  if (!t.session.loaded()) return "there is no object yet";
  return t.session.records.empty() ? "take a view first" : "";
}

std::string needs_rest(const CommandState& t) {
  return t.progress.busy ? "wait until what runs is done, or cancel it" : "";
}

std::vector<Command> scan_commands() {
  return {
      {"step",
       "Scan",
       "Take the next view",
       "Takes the next view: measures, updates the map, ranks the candidates.",
       {},
       {{key('S')}, {Key::space}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Step{}); },
       step_why_not},
      {"play",
       "Scan",
       "Play",
       "Takes views until the scan is finished or paused.",
       {},
       {{key('P')}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Play{}); },
       step_why_not},
      {"pause",
       "Scan",
       "Pause",
       "Stops taking views after the one that is under way.",
       {},
       {{key('P')}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Pause{}); },
       [](const CommandState& t) { return t.progress.playing ? "" : "no views are being taken"; }},
      {"speed",
       "Scan",
       "Pause between views…",
       "How long Play waits between two views.",
       {{"seconds", Argument::Kind::number, "from one view to the next [s]", 0, 60}},
       {},
       [](CommandTarget& t, const Arguments& a) { t.worker.set_pause_between_views(a.number(0)); }},
      {"take-view",
       "Scan",
       "Take this candidate next…",
       "Makes a candidate, or the selected one, the next view instead of the proposal.",
       {{"candidate", Argument::Kind::whole, "its number", 0, 1e6, available_candidates, true}},
       {{key('T')}},
       take_view,
       take_why_not},
      {"take-proposal",
       "Scan",
       "Take the proposal after all",
       "Makes the planner's proposal the next view again.",
       {},
       {},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::TakeView{*t.session.proposal()}); },
       [](const CommandState& t) {
         if (const std::string reason = take_why_not(t); !reason.empty()) return reason;
         if (!t.session.proposal()) return std::string("no candidate is left");
         return std::string(t.session.next_candidate == t.session.proposal() ? "it is the next view" : "");
       }},
      {"take-own-view",
       "Scan",
       "Take the own view next",
       "Makes the view that was set up with own-view the next one.",
       {},
       {{key('T'), true}},
       take_own_view,
       [](const CommandState& t) {
         if (const std::string reason = take_why_not(t); !reason.empty()) return reason;
         return std::string(t.window.selection.own_view ? "" : "set up a view of your own first (own-view)");
       }},
      {"cancel",
       "Scan",
       "Cancel what runs",
       "Stops what runs; a view that is not complete is not taken.",
       {},
       {},
       [](CommandTarget& t, const Arguments&) { t.worker.cancel(); },
       [](const CommandState& t) { return t.progress.busy ? "" : "nothing runs"; }},
      {"undo",
       "Scan",
       "Undo",
       "Goes back to before the last view, or before the last change of settings or object.",
       {},
       {{key('Z'), true}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Undo{}); },
       [](const CommandState& t) { return t.session.can_undo ? needs_rest(t) : "there is nothing to undo"; }},
      {"redo",
       "Scan",
       "Redo",
       "Does again what was undone.",
       {},
       {{key('Y'), true}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Redo{}); },
       [](const CommandState& t) { return t.session.can_redo ? needs_rest(t) : "there is nothing to redo"; }},
      {"reset",
       "Scan",
       "Start over",
       "Starts the scan over, with the same object and settings.",
       {},
       {{key('R')}},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::Reset{}); },
       needs_session},
  };
}

std::vector<Command> gibbs_commands() {
  return {
      {"refine",
       "Gibbs",
       "Refine the map",
       "Samples the Gibbs map of all views so far until it is stationary.",
       {like_setting("chains", "gibbs.chains"), like_setting("sweeps", "gibbs.sweeps")},
       {{key('G')}},
       [](CommandTarget& t, const Arguments& a) {
         const auto& sampler = t.session.configuration.gibbs.sampler;
         const int chains = a.count() > 0 ? int(a.whole(0)) : sampler.chains;
         t.worker.post(request::Refine{chains, a.count() > 1 ? int(a.whole(1)) : sampler.sweeps});
         t.window.bring_to_front(PanelName::gibbs);
       },
       [](const CommandState& t) {
         const std::string reason = needs_view(t);
         return reason.empty() ? needs_rest(t) : reason;
       }},
      {"hold-refinement",
       "Gibbs",
       "Hold the sampler",
       "Holds the sampler between two sweeps.",
       {},
       {{key('H')}},
       [](CommandTarget& t, const Arguments&) { t.worker.hold_refinement(true); },
       [](const CommandState& t) {
         return t.progress.refining && !t.progress.paused ? "" : "the sampler does not run";
       }},
      {"continue-refinement",
       "Gibbs",
       "Let the sampler go on",
       "Lets the sampler go on after hold-refinement.",
       {},
       {{key('H')}},
       [](CommandTarget& t, const Arguments&) { t.worker.hold_refinement(false); },
       [](const CommandState& t) { return t.progress.paused ? "" : "the sampler is not held"; }},
  };
}

}  // namespace nextview
