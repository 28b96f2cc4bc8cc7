#include <algorithm>
#include <stdexcept>

#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/setup_warnings.hpp"
#include "core/study/run_result.hpp"
#include "core/study/shared_by_runs.hpp"

namespace nextview {
namespace {

/// Takes the views. @throws Stopped
void take_views(Session& session, SessionFolder* folder, const Progress& progress, const std::stop_token& stop) {
  const double most = session.configuration().termination.views;
  while (session.finished().empty()) {
    throw_if_stopped(stop);
    const auto views = double(session.records().size());
    const Progress of_view = part(progress, views / most, (views + 1.0) / most);
    const bool taken = folder ? folder->step(session, of_view, stop) : session.step(of_view, stop);
    if (!taken) throw Stopped();
  }
  if (!folder) return;
  folder->keep_state(session);
  folder->close();
}

/// Of the map that views are planned on.
const MapQuality& quality_of(const StepRecord& record) {
  return record.refinement ? record.refinement->quality_near_surface : record.quality_near_surface;
}

void add_view(const Session& session, const StepRecord& r, double at, RunResult& result) {
  if (session.known_object()) {
    result.add("coverage[%]", at, 100.0 * r.coverage_visible);
    result.add("coverage_of_all[%]", at, 100.0 * r.coverage);
    if (r.coverage_any_pose) result.add("coverage_any_pose[%]", at, 100.0 * *r.coverage_any_pose);
    result.add("d_kl[nats]", at, r.quality.divergence);
    result.add("log_loss_near_surface[nats]", at, quality_of(r).log_loss);
  }
  result.add("entropy[bits]", at, r.entropy);
}

void add_step(const Session& session, const StepRecord& r, RunResult& result) {
  result.add("new_surface[cm²]", r.step, r.new_surface);
  result.add("realised_gain[nats]", r.step, r.realised_gain);
  const std::string unit(session.planner().unit());
  if (r.step > 1) result.add(unit.empty() ? "predicted_gain" : "predicted_gain[" + unit + "]", r.step, r.gain);
  if (r.surface_left) result.add("surface_left_predicted[%]", r.step, 100.0 * *r.surface_left);
}

/// After each view; a scan that ended before stays as it was.
RunResult course_of(const Session& session) {
  RunResult result;
  const auto& records = session.records();
  const Configuration& c = session.configuration();
  double path = 0.0, seconds = 0.0, coverage = 0.0;
  for (int view = 1; view <= c.termination.views && !records.empty(); ++view) {
    const std::size_t i = std::min(std::size_t(view), records.size()) - 1;
    const bool was_taken = std::size_t(view) <= records.size();
    if (was_taken) path += records[i].motion.distance, seconds += records[i].motion.seconds + c.sensor.seconds;
    if (was_taken) add_step(session, records[i], result);
    add_view(session, records[i], view, result);
    result.add("path[m]", view, path);
    result.add("robot_time[s]", view, seconds);
    coverage += records[i].coverage_visible;
  }
  result.add("views_taken", 0.0, double(records.size()));
  if (session.known_object()) result.add("mean_coverage[%]", 0.0, 100.0 * coverage / c.termination.views);
  return result;
}

/// Its zeros would go into the means as if they were the plan's doing.
void require_hits(const Session& session) {
  const auto& records = session.records();
  if (!session.mesh() || records.empty() ||
      std::ranges::any_of(records, [](const StepRecord& r) { return r.hits > 0; }))
    return;
  const auto warnings = setup_warnings(session.configuration(), *session.mesh(), session.candidates());
  throw std::runtime_error("no view measured anything" + (warnings.empty() ? "" : ": " + warnings.front()));
}

}  // namespace

RunResult perform_plan(const Configuration& configuration, SharedByRuns& shared, RunSeconds& seconds,
                       const std::optional<std::filesystem::path>& session_folder, const Progress& progress,
                       const std::stop_token& stop) {
  SessionParts parts;
  parts.objects = &shared.objects;
  Session session(configuration, std::move(parts), part(progress, 0.0, 0.1), stop);
  std::optional<SessionFolder> folder;
  if (session_folder) folder = SessionFolder::begin(OutputFolder(*session_folder, {}), session);
  take_views(session, folder ? &*folder : nullptr, part(progress, 0.1, 1.0), stop);
  for (const StepRecord& r : session.records()) {
    seconds.stages.sense += r.seconds.sense;
    seconds.stages.clean += r.seconds.clean;
    seconds.stages.insert += r.seconds.insert;
    seconds.stages.refine += r.seconds.refine;
    seconds.stages.evaluate += r.seconds.evaluate;
    seconds.stages.score += r.seconds.score;
  }
  require_hits(session);
  return course_of(session);
}

}  // namespace nextview
