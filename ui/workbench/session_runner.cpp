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

bool SessionRunner::is_own(const std::filesystem::path& folder) const { return kept_ && kept_->is_in(folder); }

SessionRunner::~SessionRunner() {
  if (kept_) kept_->close(session_.get());
}

HistoryEntry SessionRunner::now() const {
  const NextView& next = session_->state().next;
  return {session_,
          scanner_,
          kept_,
          tree_,
          tree_->at,
          tree_->branches,
          *tree_->stand(tree_->at),
          kept_->cameras(),
          next.overridden ? std::optional(next) : std::nullopt};
}

Stand SessionRunner::stand_of(const Session& session, std::shared_ptr<SeenSurface> seen) {
  const Configuration& c = session.configuration();
  return {c.termination, planning_of(c), session.planner().needs(), std::make_shared<ScanState>(session.state()),
          std::move(seen)};
}

/// The session has changed since: that can be undone.
void SessionRunner::remember(HistoryEntry before) {
  history_.push(std::move(before), tree_->stand(tree_->at)->state.get(), ScanHistory::limit(session_->configuration()));
  kept_->follow(*session_, tree_->line(tree_->at), tree_->branches);
}

void SessionRunner::keep_sessions(std::filesystem::path state, KeptSession::Notice notice) {
  state_folder_ = std::move(state);
  notice_ = std::move(notice);
}

void SessionRunner::load(Configuration configuration, const JobControl& control) {
  if (scanner_) require_goes_on(*scanner_, session_->configuration(), configuration);
  start(for_another_scan(std::move(configuration)), scanner_, control);
}

void SessionRunner::open(const std::filesystem::path& input, const JobControl& control) {
  if (is_session(input)) return open_session(input, control);
  const Configuration before = for_another_scan(scanner_ ? tree_->before_scanner : configuration());
  start(session_ ? with_next_input(before, input) : with_input(before, input), nullptr, control);
}

void SessionRunner::disconnect(const JobControl& control) {
  if (scanner_) start(tree_->before_scanner, nullptr, control);
}

void SessionRunner::connect(const ScannerWishes& wishes, std::optional<Configuration> wanted,
                            const JobControl& control) {
  const Configuration before = for_another_scan(wanted     ? *std::move(wanted)
                                                : scanner_ ? tree_->before_scanner
                                                           : configuration());
  if (!session_) wanted_ = before;
  Configuration following = before;
  forget_fitted(following);
  control.progress(0.0, "reaching the scanner");
  if (scanner_) {
    scanner_->leave();  // it may be the same one
    show_next();        // also if nothing comes of the other: that it is left
  }
  auto scanner = connect_scanner(following, wishes, control.stop);
  start(std::move(following), std::move(scanner), control);
  tree_->before_scanner = before;
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
  Stand beginning = stand_of(*session, std::make_shared<SeenSurface>(*session));
  if (session_) history_.push(now(), nullptr, ScanHistory::limit(session_->configuration()));
  auto tree = std::make_shared<StepTree>(beginning, session->camera());
  if (scanner && scanner == scanner_) tree->before_scanner = tree_->before_scanner;
  adopt({session, std::move(scanner), std::make_shared<KeptSession>(state_folder_, notice_), std::move(tree), 0,
         Branches(), std::move(beginning)});
}

void SessionRunner::set_termination(const TerminationConfig& termination) {
  if (!session_) return;
  HistoryEntry before = now();
  session_->set_termination(termination);
  tree_->set_stand(tree_->at, stand_of(*session_, seen_));
  remember(std::move(before));
  show_next();
}

void SessionRunner::set_planning(const PlanningConfig& planning, const JobControl& control) {
  if (!session_) return;
  HistoryEntry before = now();
  control.progress(0.0, "ranking the candidate views");
  session_->set_planning(planning, control.progress, control.stop);
  tree_->set_stand(tree_->at, stand_of(*session_, seen_));
  remember(std::move(before));
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

void SessionRunner::step(const JobControl& control, const Session::Judge& judge, bool with_last) {
  if (!can_step()) return;
  session_->set_judge(judge);
  HistoryEntry before = now();
  try {
    if (!kept_->step(*session_, control.progress, control.stop)) {
      if (scanner_ && scanner_->is_lost()) show_next();  // it was ended, to stop it
      if (with_last) take_back_limits();
      return;
    }
  } catch (...) {
    if (with_last) take_back_limits();
    throw;
  }
  if (with_last && history_.can_undo()) before = history_.take_last();
  before.chosen.reset();
  history_.forget_choices();
  seen_ = std::make_shared<SeenSurface>(*seen_);  // the stand before keeps its own
  tree_->step(kept_->last_number().value_or(tree_->last_number() + 1), stand_of(*session_, seen_));
  remember(std::move(before));
  show_map(*snapshot_);
  follow_compared(control);
}

/// They were lifted for a view that was not taken.
void SessionRunner::take_back_limits() {
  if (!history_.can_undo()) return;
  session_->set_termination(history_.take_last().stand.termination);
  tree_->set_stand(tree_->at, stand_of(*session_, seen_));
  kept_->follow(*session_, tree_->line(tree_->at), tree_->branches);
  show_next();
}

void SessionRunner::take_view(std::size_t candidate) {
  if (session_) choose([&] { session_->override_next_view(candidate); });
}

void SessionRunner::take_custom_view(const Pose& T_world_camera) {
  if (session_) choose([&] { session_->override_next_view(T_world_camera); });
}

/// Another view is taken next: that can be undone.
void SessionRunner::choose(const std::function<void()>& change) {
  HistoryEntry before = now();
  before.is_choice = true;
  const View view = session_->state().next.view;
  change();
  if (!(session_->state().next.view == view)) remember(std::move(before));
  show_next();
}

void SessionRunner::undo(const JobControl& control) {
  if (history_.can_undo())
    adopt(history_.undo(now(), ScanHistory::limit(session_->configuration()), control.progress, control.stop));
  follow_compared(control);
}

void SessionRunner::redo(const JobControl& control) {
  if (history_.can_redo())
    adopt(history_.redo(now(), ScanHistory::limit(session_->configuration()), control.progress, control.stop));
  follow_compared(control);
}

/// What cannot be reached any more stays the planner's choice.
void SessionRunner::choose_again(const NextView& chosen) {
  try {
    if (chosen.candidate)
      session_->override_next_view(*chosen.candidate);
    else
      session_->override_next_view(chosen.view.T_world_camera);
  } catch (const std::invalid_argument&) {
  }
}

/// Goes on from there. The next view is the planner's choice again, or what the operator had chosen there.
void SessionRunner::adopt(HistoryEntry entry) {
  const bool same_session = session_ == entry.session;
  if (!same_session) {
    put_off_.clear();
    sight_put_off_ = true;
  }
  const bool same_scan = same_session && session_->scans() == entry.stand.state->scans;
  const Planner* const planner = session_ ? &session_->planner() : nullptr;
  SessionSnapshot next = *snapshot_;
  if (kept_ && kept_ != entry.kept) kept_->close(session_.get());
  if (scanner_ && scanner_ != entry.scanner) scanner_->leave();
  session_ = std::move(entry.session);
  scanner_ = std::move(entry.scanner);
  kept_ = std::move(entry.kept);
  tree_ = std::move(entry.tree);
  history_.go_on_with(session_, tree_);
  tree_->at = entry.at;
  tree_->go_back_to(entry.branches);
  session_->restore(*entry.stand.state, entry.stand.planning);
  session_->set_termination(entry.stand.termination);
  session_->take_proposal();
  if (entry.chosen) choose_again(*entry.chosen);
  kept_->follow(*session_, tree_->line(tree_->at), tree_->branches);
  if (kept_->cameras() != entry.cameras) kept_->set_cameras(std::move(entry.cameras));
  seen_ = entry.stand.seen;
  tree_->set_stand(entry.at, std::move(entry.stand));
  if (same_scan && planner == &session_->planner()) return show_next();
  const auto& scans = session_->scans();
  // What was refined of views that are no more belongs to nothing; the map of a session that is back, to it again.
  const auto begin_with = [&](const std::vector<std::shared_ptr<const Scan>>& first) {
    return first.size() <= scans.size() && std::equal(first.begin(), first.end(), scans.begin());
  };
  if (!same_session || !begin_with(refined_scans_)) {
    refinement_.reset();
    refined_scans_.clear();
  }
  const RefinedMap& refined = tree_->refined;
  next.gibbs = refined.map && begin_with(refined.scans) ? refined.map : nullptr;
  if (!same_session) {
    next.compared = nullptr;
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
  const bool is_there = snapshot_->gibbs != nullptr;
  const auto progress = [&](double fraction, std::string_view what, const SamplerDiagnostics& so_far) {
    // Before the first mean there is nothing to keep, and a few sweeps are no match for a map that is there.
    if (is_there || so_far.informed_voxels == 0) throw_if_stopped(control.stop);
    control.sampler(so_far);
    control.progress(0.1 + 0.9 * fraction, what);
  };
  refinement_->refine(&session_->map().voxels(), 0, progress, control.stop);
  if (is_there) throw_if_stopped(control.stop);
  SessionSnapshot next = *snapshot_;
  show_refinement(next, *refinement_);
  tree_->refined.map = next.gibbs;
  tree_->refined.scans = session_->scans();
  publish(std::move(next));
}

void SessionRunner::forget_runs() {
  SessionSnapshot next = *snapshot_;
  next.earlier_runs = nullptr;
  publish(std::move(next));
}

}  // namespace nextview
