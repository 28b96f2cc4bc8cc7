// What a session worker tells the log of what was done.
#include <fmt/format.h>

#include <numbers>

#include "core/config/object_lengths.hpp"
#include "core/file/counted.hpp"
#include "core/file/read_file.hpp"
#include "core/session/recent_files.hpp"
#include "core/session/setup_warnings.hpp"
#include "core/setting/area_text.hpp"
#include "core/setting/length_text.hpp"
#include "ui/workbench/request_kind.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {
namespace {

using Level = LogEntry::Level;

/// Another session took the place of the one before.
void log_start(const SessionRequest& request, const SessionSnapshot& before, const SessionSnapshot& now,
               SessionLog& log) {
  if (const std::size_t views = before.views_on_branches(); views > 0 && starts_anew(request))
    log.add(Level::note, fmt::format("{} starts the scan over; undo (Ctrl+Z) brings its {} back",
                                     is<request::Load>(request)         ? "This setting"
                                     : is<request::OpenFile>(request)   ? "Another file"
                                     : is<request::Connect>(request)    ? "A scanner"
                                     : is<request::Disconnect>(request) ? "To leave the scanner"
                                                                        : "Start over",
                                     views == 1 ? "view" : fmt::format("{} views", views)));
  if (!now.mesh || now.is_recording()) {
    log.add(Level::note,
            fmt::format("{}: region {}, {}, {:g} mm voxels", now.object_name, size_text(now.grid.box()),
                        counted(now.candidates.size(), now.is_recording() ? "recorded frame" : "candidate view"),
                        1e3 * now.grid.resolution));
    for (const std::string& note : now.notes) log.add(Level::note, note);
    return;
  }
  const std::string unit =
      now.guessed_unit.empty() ? "" : fmt::format(" (its unit taken as {}; object.unit sets it)", now.guessed_unit);
  log.add(Level::note, fmt::format("{}: {}{}, {}, {}, {:g} mm voxels", now.object_name, size_text(now.object_box), unit,
                                   counted(now.mesh->triangles.size(), "triangle"),
                                   counted(now.candidates.size(), "candidate view"), 1e3 * now.grid.resolution));
  for (const std::string& note : now.notes) log.add(Level::note, note);
  if (!now.records.empty()) log.add(Level::note, fmt::format("Goes on with {}", counted(now.records.size(), "view")));
  for (const std::string& warning : setup_warnings(now.configuration, *now.mesh, now.candidates))
    log.add(Level::warning, warning);
}

/// A note alone: the control bar says it as long as it is so.
void log_end(const SessionSnapshot& now, SessionLog& log) {
  log.add(Level::note, "The scan is finished: " + now.finished);
}

void log_view(const SessionSnapshot& now, SessionLog& log) {
  const StepRecord& r = now.records.back();
  const std::string from = r.view < 0 ? r.overridden ? "your custom view" : "the start view"
                                      : fmt::format("{} {}", now.is_recording() ? "frame" : "candidate", r.view);
  log.add(Level::note, fmt::format("View {} from {}{}: {}, {} of new surface", r.step, from,
                                   r.view >= 0 && r.overridden ? " (your choice)" : "", counted(r.points, "point"),
                                   area_text(r.new_surface)));
  if (r.registration)
    log.add(Level::note,
            r.registration->reliable
                ? fmt::format("View {} lay {} and {:.2g}° off the scans before it", r.step,
                              length_text(r.registration->shift), r.registration->rotation * 180.0 / std::numbers::pi)
                : fmt::format("View {} was not registered: {}", r.step, r.registration->why_not));
  if (!r.ranking.degenerate.empty() && now.finished.empty())  // nothing is chosen by it any more
    log.add(Level::warning, fmt::format("The ranking after view {} says little: {}", r.step, r.ranking.degenerate));
  if (!now.finished.empty()) log_end(now, log);
}

/// A view that was taken where there were others after it left them where they are.
void log_branch(const SessionSnapshot& before, const SessionSnapshot& now, SessionLog& log) {
  const Branches &was = before.timeline->branches, &is = now.timeline->branches;
  if (was.on == is.on) return;
  const std::size_t left = now.timeline->line(was.current()).size();
  log.add(Level::note, fmt::format("This begins '{}'; '{}' keeps its {}", is.current().name, was.current().name,
                                   counted(left, "view")));
}

/// Where the scan stands after another one of its states came back, or by what it goes on from the same.
void log_place(const SessionSnapshot& before, const SessionSnapshot& now, SessionLog& log) {
  const Branch &was = before.timeline->branches.current(), &is = now.timeline->branches.current();
  const std::size_t views = now.records.size();
  if (is.id == was.id && views == before.records.size()) {
    if (views > 0) log.add(Level::note, "The candidates are ranked anew; the scan stays");
    return;
  }
  const std::string branch = is.id == was.id ? "" : fmt::format(" of '{}'", is.name);
  log.add(Level::note, views > before.records.size() ? fmt::format("At view {}{} again", views, branch)
                                                     : fmt::format("Back at view {}{}", views, branch));
}

/// How a refinement went; of one that was cancelled, what is left of it.
void log_refinement(const GibbsMap& gibbs, bool cancelled, SessionLog& log) {
  const SamplerDiagnostics& d = gibbs.posterior->diagnostics;
  const std::string map = "Gibbs map of " + counted(gibbs.views, "view"), sweeps = counted(d.sweeps, "sweep");
  if (cancelled)
    return log.add(Level::note, fmt::format("The refinement is cancelled: the {} keeps its {}", map, sweeps));
  if (d.stationary) return log.add(Level::success, fmt::format("{}: stationary after {}", map, sweeps));
  log.add(Level::warning, fmt::format("{}: {}", map, d.warning));
}

/// A scan that was finished is not any more: what ends it now.
std::string going_on(const SessionSnapshot& now) {
  const TerminationConfig& limits = now.configuration.termination;
  const int left = limits.views - int(now.records.size());
  std::string text = "The scan goes on";
  if (limits.limits_views()) text += fmt::format(" for {} at most", counted(std::size_t(left), "more view"));
  if (limits.surface_left == 0.0) text += ", however little surface is left";
  return text + "; undo brings the limits back";
}

}  // namespace

std::string what_was_cancelled(const SessionRequest& request, const SessionSnapshot& before) {
  if (is<request::Refine>(request)) {
    if (!before.gibbs) return "The refinement is cancelled: there is no Gibbs map yet";
    return fmt::format("The refinement is cancelled: the Gibbs map of {} stays as it was",
                       counted(before.gibbs->views, "view"));
  }
  if (is<request::Step>(request)) return "The view is cancelled: it is not part of the scan";
  if (is<request::Export>(request) || is<request::ExportOne>(request)) return "The export is cancelled";
  if (!opens_another(request)) return "Cancelled";
  return before.loaded() ? fmt::format("Opening is cancelled: {} stays as it was", before.object_name)
                         : "Opening is cancelled";
}

void SessionWorker::finish(const SessionRequest& request, const SessionSnapshot& before) {
  const SessionSnapshot& s = *runner_.snapshot();
  const auto* opened = std::get_if<request::OpenFile>(&request);
  const auto* changed = std::get_if<request::ChangeSetting>(&request);
  if (opened && is_there(opened->file)) add_recent_file(state_folder_, opened->file);
  if (s.session != before.session) {
    log_start(request, before, s, log_);
  } else if (is<request::Step>(request) && s.records.size() > before.records.size()) {
    log_branch(before, s, log_);
    log_view(s, log_);
  } else if (is<request::SetTermination>(request) || (changed && changed->key.starts_with("termination."))) {
    if (s.finished != before.finished) s.finished.empty() ? log_.add(Level::note, going_on(s)) : log_end(s, log_);
  } else if (s.scanner_lost && !before.scanner_lost) {
    log_.add(Level::warning,
             "Stopped by ending the scanner's program, which cannot stop a move itself; reach it again");
  } else if (is<request::Step>(request) && s.finished != before.finished) {
    log_end(s, log_);  // Continue took no view: the limits hold again
  } else if (s.map != before.map && !is<request::Refine>(request)) {
    log_place(before, s, log_);
  } else if (is<request::BeginBranch>(request)) {
    log_.add(Level::note, fmt::format("What is taken from here on is on '{}'", s.timeline->branches.current().name));
  }
  if (is<request::Refine>(request) && s.gibbs && s.gibbs != before.gibbs)
    log_refinement(*s.gibbs, job_control().stop.stop_requested(), log_);
  if (const auto* e = std::get_if<request::Export>(&request))
    log_.add(Level::success, "Scan written to " + e->folder.string());
}

}  // namespace nextview
