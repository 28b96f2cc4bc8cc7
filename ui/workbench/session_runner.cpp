#include "ui/workbench/session_runner.hpp"

#include <algorithm>
#include <utility>

#include "core/config/object_lengths.hpp"
#include "core/config/opened_input.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

std::size_t history_limit(const Session& session) {
  return static_cast<std::size_t>(session.configuration().history.memory * 1073741824.0);
}

}  // namespace

HistoryEntry SessionRunner::now() const {
  const Configuration& c = session_->configuration();
  return {session_, c.termination, c.planner, session_->state(), *seen_, scanner_, kept_, kept_->line()};
}

void SessionRunner::keep_sessions(std::filesystem::path state, KeptSession::Notice notice) {
  state_folder_ = std::move(state);
  notice_ = std::move(notice);
}

void SessionRunner::load(Configuration configuration, const JobControl& control) {
  if (scanner_) require_goes_on(*scanner_, session_->configuration(), configuration);
  start(std::move(configuration), scanner_, control);
}

void SessionRunner::open(const std::filesystem::path& input, const JobControl& control) {
  if (is_session(input)) return open_session(input, control);
  start(with_input(scanner_ ? before_scanner_ : configuration(), input), nullptr, control);
}

void SessionRunner::disconnect(const JobControl& control) {
  if (scanner_) start(before_scanner_, nullptr, control);
}

void SessionRunner::connect(const ScannerWishes& wishes, std::optional<Configuration> wanted,
                            const JobControl& control) {
  const Configuration before = wanted ? *std::move(wanted) : scanner_ ? before_scanner_ : configuration();
  if (!session_) wanted_ = before;
  Configuration following = before;
  forget_fitted(following);
  control.progress(0.0, "reaching the scanner");
  if (scanner_) scanner_->leave();  // it may be the same one
  auto scanner = connect_scanner(following, wishes, control.stop);
  start(std::move(following), std::move(scanner), control);
  before_scanner_ = before;
}

void SessionRunner::reconnect(const JobControl& control) {
  if (!scanner_) return;
  if (const auto failure = scanner_->reconnect(control.stop)) throw std::runtime_error(failure->reason);
  show_next();
}

void SessionRunner::start(Configuration configuration, std::shared_ptr<DriverConnection> scanner,
                          const JobControl& control) {
  configuration.validate();
  if (!session_) wanted_ = configuration;
  SessionParts parts = scanner ? scanner_parts(configuration, scanner) : SessionParts{};
  auto session = std::make_shared<Session>(std::move(configuration), std::move(parts), control.progress, control.stop);
  if (session_) history_.push(now(), history_limit(*session_));
  const Configuration& c = session->configuration();
  adopt({session, c.termination, c.planner, session->state(), SeenSurface(*session), std::move(scanner),
         std::make_shared<KeptSession>(state_folder_, notice_)});
}

/// It goes on where it stands, in its own folder. Each of its views can be undone.
void SessionRunner::open_session(const std::filesystem::path& folder, const JobControl& control) {
  SavedSession saved = read_session(folder);
  const Configuration& c = saved.configuration;
  SessionParts parts = c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  const auto session = std::make_shared<Session>(c, std::move(parts), part(control.progress, 0.0, 0.2), control.stop);
  std::optional<SessionFolder> own;
  try {
    if (saved.journal) own = SessionFolder::go_on(OutputFolder(folder, {}), saved, *session);
  } catch (const std::runtime_error& error) {
    saved.notices.push_back(std::string(error.what()) + ": it is shown, and what is done here is not kept there");
  }
  const auto kept = saved.journal ? std::make_shared<KeptSession>(std::move(own), notice_)
                                  : std::make_shared<KeptSession>(state_folder_, notice_);
  SeenSurface seen(*session);
  std::vector<HistoryEntry> states;
  const auto look = [&] {
    seen.follow(*session);
    states.push_back({session, c.termination, session->configuration().planner, session->state(), seen, nullptr, kept,
                      kept->line()});
  };
  look();
  if (!restore(*session, saved, kept->folder(), look, part(control.progress, 0.2, 1.0), control.stop)) throw Stopped();
  if (session_) history_.push(now(), history_limit(*session_));
  for (std::size_t k = 0; k + 1 < states.size(); ++k) history_.push(states[k], history_limit(*session));
  adopt(std::move(states.back()));
  for (const std::string& notice : saved.notices)
    if (notice_) notice_(folder.string() + ": " + notice);
}

void SessionRunner::set_termination(const TerminationConfig& termination) {
  if (!session_) return;
  HistoryEntry before = now();
  session_->set_termination(termination);
  history_.push(std::move(before), history_limit(*session_));
  kept_->follow(*session_, kept_->line());
  show_next();
}

void SessionRunner::set_planner(const PlannerConfig& planner, const JobControl& control) {
  if (!session_) return;
  HistoryEntry before = now();
  control.progress(0.0, "ranking the candidate views");
  session_->set_planner(planner, control.progress, control.stop);
  history_.push(std::move(before), history_limit(*session_));
  kept_->follow(*session_, kept_->line());
  SessionSnapshot next = *snapshot_;
  next.configuration = session_->configuration();
  show_map(std::move(next));
}

void SessionRunner::show_next() {
  SessionSnapshot next = *snapshot_;
  next.configuration = session_->configuration();
  next.finished = session_->finished();
  show_next_view(next);
  publish(std::move(next));
}

void SessionRunner::step(const JobControl& control, const Session::Judge& judge) {
  if (!can_step()) return;
  session_->set_judge(judge);
  HistoryEntry before = now();
  if (!kept_->step(*session_, control.progress, control.stop)) {
    if (scanner_ && scanner_->is_lost()) show_next();  // it was ended, to stop it
    return;
  }
  history_.push(std::move(before), history_limit(*session_));
  show_map(*snapshot_);
}

void SessionRunner::take_view(std::size_t candidate) {
  if (!session_) return;
  session_->override_next_view(candidate);
  show_next();
}

void SessionRunner::take_custom_view(const Pose& T_world_camera) {
  if (!session_) return;
  session_->override_next_view(T_world_camera);
  show_next();
}

void SessionRunner::undo(const JobControl& control) {
  if (history_.can_undo()) adopt(history_.undo(now(), history_limit(*session_), control.progress, control.stop));
}

void SessionRunner::redo(const JobControl& control) {
  if (history_.can_redo()) adopt(history_.redo(now(), history_limit(*session_), control.progress, control.stop));
}

/// Goes on from there. The next view is the planner's choice again.
void SessionRunner::adopt(HistoryEntry entry) {
  const bool same_session = session_ == entry.session;
  const bool same_scan = same_session && session_->scans() == entry.state.scans;
  const Planner* const planner = session_ ? &session_->planner() : nullptr;
  SessionSnapshot next = *snapshot_;
  if (kept_ && kept_ != entry.kept) kept_->close();
  if (scanner_ && scanner_ != entry.scanner) scanner_->leave();
  session_ = std::move(entry.session);
  scanner_ = std::move(entry.scanner);
  kept_ = std::move(entry.kept);
  session_->restore(std::move(entry.state), entry.planner);
  session_->set_termination(entry.termination);
  session_->take_proposal();
  kept_->follow(*session_, entry.line);
  seen_ = std::move(entry.seen);
  if (same_scan && planner == &session_->planner()) return show_next();
  const auto& scans = session_->scans();
  // What was refined of views that are no more belongs to nothing.
  const auto begin_with = [&](const std::vector<std::shared_ptr<const Scan>>& first, std::size_t views) {
    return same_session && views <= scans.size() && std::equal(first.begin(), first.begin() + views, scans.begin());
  };
  if (!begin_with(refined_scans_, refined_scans_.size())) {
    refinement_.reset();
    refined_scans_.clear();
  }
  if (next.gibbs && !begin_with(next.scans, next.gibbs->views)) next.gibbs = nullptr;
  if (!same_session) {
    ++next.session;
    remember_run(next);
    show_session(next);
  }
  show_map(std::move(next));
}

void SessionRunner::refine(int chains, int sweeps, const JobControl& control) {
  if (!session_ || session_->scans().empty()) return;
  PosteriorSamplerConfig config = posterior_sampler_config(session_->configuration());
  config.chains = chains;
  config.sweeps = sweeps;
  config.keep_traces = true;
  config.validate();
  const bool same = refinement_ && refinement_->config().chains == chains && refinement_->config().sweeps == sweeps;
  if (!same) {
    refinement_ = std::make_unique<GibbsState>(session_->map().grid(), config, session_->map().model());
    refined_scans_.clear();
  }
  const auto& scans = session_->scans();
  while (refined_scans_.size() < scans.size()) {
    throw_if_stopped(control.stop);
    control.progress(0.1 * double(refined_scans_.size()) / double(scans.size()), "merging the rays of each view");
    refinement_->add(*scans[refined_scans_.size()]);
    refined_scans_.push_back(scans[refined_scans_.size()]);
  }
  const auto progress = [&](double fraction, std::string_view what, const SamplerDiagnostics& so_far) {
    control.sampler(so_far);
    control.progress(0.1 + 0.9 * fraction, what);
  };
  refinement_->refine(probabilities(session_->map().voxels()), 0, progress, control.stop);
  SessionSnapshot next = *snapshot_;
  show_refinement(next, *refinement_);
  publish(std::move(next));
}

void SessionRunner::forget_runs() {
  SessionSnapshot next = *snapshot_;
  next.earlier_runs = nullptr;
  publish(std::move(next));
}

}  // namespace nextview
