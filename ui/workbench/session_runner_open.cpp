// How a session runner opens a session that was kept.
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/state_file.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {
namespace {

/// A session that was restored at once stands at each of its views in turn, without the maps of then.
void look_at_each_view(Session& session, const SavedSession& saved, const std::function<void(std::uint32_t)>& look,
                       const SessionRunner::JobControl& control) {
  const ScanState last = session.state();
  const PlanningConfig now = session.planning();
  const std::vector<JournalStep> line = saved.journal->line();
  for (std::size_t k = 1; k < line.size(); ++k) {
    throw_if_stopped(control.stop);
    control.progress(0.2 + 0.8 * double(k) / double(line.size()), "opening the session");
    const JournalStep& step = line[k - 1];
    const PlanningConfig planning = chosen_by(saved, line[k]);
    session.restore(earlier_state(session.setup_with(planning), last, k, step.reached), planning);
    look(step.number);
  }
  session.restore(last, now);
  look(line.back().number);
}

}  // namespace

/// What Continue lifted is lifted for this scan alone: the limits of another are those on the way here before it.
Configuration SessionRunner::for_another_scan(Configuration configuration) const {
  if (!session_ || configuration.termination != session_->configuration().termination) return configuration;
  std::vector<std::uint32_t> way = tree_->line(tree_->at);
  way.insert(way.begin(), 0);
  const auto is_lifted = [&](std::uint32_t number) {
    const std::optional<Stand>& stand = tree_->stand(number);
    return !stand || stand->termination.is_lifted();
  };
  while (way.size() > 1 && is_lifted(way.back())) way.pop_back();
  configuration.termination = tree_->stand(way.back())->termination;
  return configuration;
}

/// It goes on where it stands, in its own folder. Undo ends there: its views are gone along in the timeline.
void SessionRunner::open_session(const std::filesystem::path& folder, const JobControl& control) {
  if (is_own(folder)) throw std::invalid_argument(folder.string() + ": is the session that is open");
  if (std::optional<HistoryEntry> left = history_.left_in(folder, control.progress, control.stop)) {
    history_.push(now(), left->stand.state.get(), ScanHistory::limit(left->session->configuration()));
    return adopt(*std::move(left));  // it is this program that writes it: nobody could go on with it who read it
  }
  const auto shared = std::make_shared<SavedSession>(read_session(folder));
  SavedSession& saved = *shared;
  const Configuration& c = saved.configuration;
  SessionParts parts = c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  const auto session =
      std::make_shared<Session>(began_with(saved), std::move(parts), part(control.progress, 0.0, 0.2), control.stop);
  session->recognise_fitted();
  const std::shared_ptr<KeptSession> kept = kept_of(saved, *session);
  const SeenSurface nothing_seen(*session);
  const auto seen = [&] { return std::make_shared<SeenSurface>(nothing_seen); };
  const auto tree = std::make_shared<StepTree>(stand_of(*session, seen()), session->camera());
  if (saved.journal) tree->add(shared);
  const auto taken = [&](std::uint32_t number) {
    if (!tree->has(number)) return static_cast<void>(tree->step(number, stand_of(*session, seen())));
    tree->set_stand(number, stand_as_saved(*session, seen(), saved, number));
    tree->at = number;
  };
  if (restore_kept(*session, saved, kept->record())) {
    std::vector<std::uint32_t> numbers;
    for (const JournalStep& step : saved.journal->line()) numbers.push_back(step.number);
    tree->take_pictures(numbers, session->state());
    look_at_each_view(*session, saved, taken, control);
  } else if (!restore(*session, saved, kept->record(), taken, part(control.progress, 0.2, 1.0), control.stop))
    throw Stopped();
  tree->set_stand(tree->at, stand_of(*session, seen()));  // the planner may have changed since
  adopt_opened(session, kept, tree);
  if (control.shown) control.shown();
  compare_what_is_shown();
  tell_notices(saved, 0);
}

void SessionRunner::compare_what_is_shown() {
  seen_->compare(session_->scans());
  SessionSnapshot next = *snapshot_;
  ++next.map;
  next.cloud = seen_->cloud();
  next.missed = seen_->missed();
  publish(std::move(next));
}

void SessionRunner::tell_notices(const SavedSession& saved, std::size_t first) const {
  const std::string folder = saved.folder.string();
  for (std::size_t k = first; notice_ && k < saved.notices.size(); ++k)
    notice_(saved.notices[k].starts_with(folder) ? saved.notices[k] : folder + ": " + saved.notices[k]);
}

/// With the end that was set there, too.
Stand SessionRunner::stand_as_saved(const Session& session, std::shared_ptr<SeenSurface> seen,
                                    const SavedSession& saved, std::uint32_t number) {
  Stand stand = stand_of(session, std::move(seen));
  stand.termination = settings_at(saved, number).termination;
  return stand;
}

/// In its own folder if this program can write it; what has no journal is kept anew.
std::shared_ptr<KeptSession> SessionRunner::kept_of(SavedSession& saved, const Session& session) const {
  if (!saved.journal) {
    const auto kept = std::make_shared<KeptSession>(state_folder_, notice_);
    kept->begin(session);
    return kept;
  }
  try {
    return std::make_shared<KeptSession>(SessionFolder::go_on(OutputFolder(saved.folder, {}), saved, session), notice_);
  } catch (const std::runtime_error& error) {
    saved.notices.push_back(std::string(error.what()) + ": it is shown, and what is done here is not kept there");
    return std::make_shared<KeptSession>(SessionFolder::in_memory(session, &saved), notice_);
  }
}

/// What is undone is what was done in this window: opening the session, not what it came with.
void SessionRunner::adopt_opened(const std::shared_ptr<Session>& session, const std::shared_ptr<KeptSession>& kept,
                                 const std::shared_ptr<StepTree>& tree) {
  struct Later {
    bool& later;
    ~Later() { later = false; }
  } const compares{compares_later_ = true};
  if (session_) history_.push(now(), nullptr, ScanHistory::limit(session->configuration()));
  adopt({session, nullptr, kept, tree, tree->at, tree->branches, *tree->stand(tree->at), kept->cameras()});
  put_off_ = tree->line(tree->at);
}

/// Each is made of the one before. Where there is no room for one there is none for those after it.
bool SessionRunner::catch_up(const std::stop_token& stop) {
  if (std::exchange(sight_put_off_, false)) {
    if (session_->known_object()) session_->known_object()->sight({}, stop);
    return is_behind();
  }
  const std::vector<std::uint32_t> steps = std::exchange(put_off_, {});
  if (steps.empty() || !tree_ || !tree_->has(steps.front())) return false;  // another session is open by now
  const auto& stand = tree_->stand(steps.front());
  if (stand) tree_->follow_seen(steps.front());
  if (stand && !stand->state->has_maps) {
    ScanHistory::bring_back_maps(*session_, *tree_, steps.front(), *stand, {}, stop);
    history_.keep_within(ScanHistory::limit(session_->configuration()), tree_->stand(tree_->at)->state.get());
    if (!stand->state->has_maps) return false;
  }
  put_off_.assign(steps.begin() + 1, steps.end());
  return is_behind();
}

}  // namespace nextview
