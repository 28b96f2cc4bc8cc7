// Where a session runner goes along the steps that were taken.
#include <fmt/format.h>

#include <algorithm>

#include "core/file/counted.hpp"
#include "core/progress/stopped.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {

/// What is not here yet is taken again from its captures.
Stand SessionRunner::stand_at(std::uint32_t number, const JobControl& control) {
  const std::vector<JournalStep> missing = tree_->not_here(number);
  const std::uint32_t from = tree_->nearest_here(number);
  const Stand nearest = *tree_->stand(from);
  ScanHistory::bring_back_maps(*session_, *tree_, from, nearest, control.progress, control.stop);
  if (missing.empty()) return nearest;
  const ScanState here = session_->state();
  const PlanningConfig planning = session_->planning();
  const auto come_back = [&] { session_->restore(here, planning); };
  const std::size_t notices = tree_->saved()->notices.size();
  try {
    session_->restore(*nearest.state, nearest.planning);
    const auto taken = [&](std::uint32_t step) {
      const auto seen = std::make_shared<SeenSurface>(*nearest.seen);
      tree_->set_stand(step, stand_as_saved(*session_, seen, *tree_->saved(), step));
    };
    if (!take_again(*session_, *tree_->saved(), missing, taken, control.progress, control.stop)) throw Stopped();
  } catch (...) {
    come_back();
    throw;
  }
  come_back();
  const auto& stand = tree_->stand(number);
  if (!stand) throw std::runtime_error(tree_->saved()->notices.at(notices));
  tell_notices(*tree_->saved(), notices);
  return *stand;
}

void SessionRunner::go_to(const std::string& name, std::optional<std::size_t> views, const JobControl& control) {
  if (!tree_) return;
  HistoryEntry before = now(), after = before;
  after.branches.on = name.empty() ? before.branches.on : before.branches.find(name);
  const Branch& branch = after.branches.current();
  const std::vector<std::uint32_t> line = tree_->line(branch.tip);
  if (views && *views > line.size())
    throw std::invalid_argument(fmt::format("'{}' has {}", branch.name, counted(line.size(), "view")));
  const std::size_t last = views.value_or(line.size());
  after.at = last == 0 ? 0 : line[last - 1];
  if (after.at == before.at && after.branches.on == before.branches.on) return;
  if (after.at != before.at) after.chosen.reset();  // it was chosen with other views in sight
  after.stand = stand_at(after.at, control);
  // Going along the timeline is one change, however many views it goes by.
  const std::size_t limit = ScanHistory::limit(session_->configuration());
  if (!history_.can_undo() || history_.last_change() != change_when_gone_ || history_.can_redo())
    history_.push(before, after.stand.state.get(), limit);
  else
    history_.keep_within(limit, after.stand.state.get());
  change_when_gone_ = history_.last_change();
  const bool is_swapped = snapshot_->compared && snapshot_->compared->branch == branch.name;
  adopt(std::move(after));
  if (is_swapped) go_on_comparing(before.branches.current().name, control);
  follow_compared(control);
}

void SessionRunner::begin_branch(const std::string& name) {
  change_branches([&](Branches& branches) { branches.begin(name.empty() ? branches.free_name() : name, tree_->at); });
}

void SessionRunner::rename_branch(const std::string& name, const std::string& to) {
  const std::shared_ptr<const Comparison> compared = snapshot_->compared;
  change_branches([&](Branches& branches) { branches.rename(name, to); });
  if (!compared || compared->branch != name) return;
  SessionSnapshot next = *snapshot_;
  next.compared = std::make_shared<const Comparison>(Comparison{to, compared->snapshot});
  publish(std::move(next));
}

void SessionRunner::remove_branch(const std::string& name) {
  change_branches([&](Branches& branches) { branches.remove(name); });
}

void SessionRunner::change_branches(const std::function<void(Branches&)>& change) {
  if (!tree_) return;
  Branches branches = tree_->branches;
  change(branches);
  HistoryEntry before = now();
  tree_->branches = std::move(branches);
  remember(std::move(before));
  publish(*snapshot_);
}

void SessionRunner::keep_camera(const CameraBookmark& camera) {
  change_cameras([&](std::vector<CameraBookmark>& cameras) { keep(cameras, camera); });
}

void SessionRunner::remove_camera(const std::string& name) {
  change_cameras([&](std::vector<CameraBookmark>& cameras) { forget(cameras, name); });
}

void SessionRunner::change_cameras(const std::function<void(std::vector<CameraBookmark>&)>& change) {
  if (!tree_) return;
  std::vector<CameraBookmark> cameras = kept_->cameras();
  change(cameras);
  HistoryEntry before = now();
  kept_->set_cameras(std::move(cameras));
  remember(std::move(before));
  publish(*snapshot_);
}

void SessionRunner::compare(const std::string& name, const JobControl& control, bool view_for_view) {
  if (!tree_) return;
  view_for_view_ = view_for_view;
  SessionSnapshot next = *snapshot_;
  next.compared = nullptr;
  if (!name.empty()) {
    const Branch& branch = tree_->branches.all[tree_->branches.find(name)];
    const std::vector<std::uint32_t> line = tree_->line(branch.tip);
    const std::size_t views = std::min(view_for_view ? tree_->line(tree_->at).size() : line.size(), line.size());
    const std::uint32_t number = views == 0 ? 0 : line[views - 1];
    auto there = std::make_shared<const SessionSnapshot>(snapshot_of(stand_at(number, control)));
    next.compared = std::make_shared<const Comparison>(Comparison{branch.name, std::move(there)});
    history_.keep_within(ScanHistory::limit(session_->configuration()), tree_->stand(tree_->at)->state.get());
  }
  publish(std::move(next));
}

/// After this branch has gone on or back.
void SessionRunner::follow_compared(const JobControl& control) {
  if (view_for_view_ && snapshot_->compared) go_on_comparing(std::string(snapshot_->compared->branch), control);
}

/// What was done before it has been done, whether or not the other branch can be shown now: it is left away if not.
void SessionRunner::go_on_comparing(const std::string& branch, const JobControl& control) {
  try {
    compare(branch, control, view_for_view_);
  } catch (const std::exception& error) {
    compare("", control);
    if (notice_) notice_(fmt::format("'{}' is compared no longer: {}", branch, error.what()));
  }
}

/// What the window would show if the session stood there.
SessionSnapshot SessionRunner::snapshot_of(const Stand& stand) {
  const ScanState here = session_->state();
  const PlanningConfig planning = session_->planning();
  const TerminationConfig termination = session_->configuration().termination;
  const auto seen = std::exchange(seen_, stand.seen);
  const auto come_back = [&] {
    session_->restore(here, planning);
    session_->set_termination(termination);
    seen_ = seen;
  };
  SessionSnapshot there = *snapshot_;
  there.compared = nullptr;
  there.gibbs = nullptr;
  try {
    session_->restore(*stand.state, stand.planning);
    session_->set_termination(stand.termination);
    fill_map(there);
  } catch (...) {
    come_back();
    throw;
  }
  come_back();
  return there;
}

}  // namespace nextview
