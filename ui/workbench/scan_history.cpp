#include "ui/workbench/scan_history.hpp"

#include <set>
#include <utility>

namespace nextview {
namespace {

constexpr std::size_t max_sessions = 4;  ///< in the history: each has a mesh of its own, a ray scene, a truth

/// The farthest entries are forgotten until there are few sessions.
void keep_few_sessions(std::vector<HistoryEntry>& entries) {
  std::set<const Session*> sessions;
  std::size_t first = entries.size();
  while (first > 0) {
    sessions.insert(entries[first - 1].session.get());
    if (sessions.size() > max_sessions) break;
    --first;
  }
  entries.erase(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

/// A state that is kept, and one that it has most in common with.
struct ScanHistory::Held {
  const Session* session;
  ScanState* state;
  const ScanState* neighbour;  ///< may be null

  std::size_t bytes() const { return bytes_of(*state, neighbour); }
};

void ScanHistory::push(HistoryEntry before, const ScanState* now, std::size_t limit) {
  redo_.clear();
  before.change = ++changes_;
  undo_.push_back(std::move(before));
  keep_few_sessions(undo_);
  keep_within(limit, now);
}

HistoryEntry ScanHistory::take_last() {
  HistoryEntry last = std::move(undo_.back());
  undo_.pop_back();
  return last;
}

void ScanHistory::forget_choices() {
  while (!undo_.empty() && undo_.back().is_choice) undo_.pop_back();
}

HistoryEntry ScanHistory::undo(HistoryEntry now, std::size_t limit, const Progress& progress,
                               const std::stop_token& stop) {
  return travel(undo_, redo_, std::move(now), limit, progress, stop);
}

HistoryEntry ScanHistory::redo(HistoryEntry now, std::size_t limit, const Progress& progress,
                               const std::stop_token& stop) {
  return travel(redo_, undo_, std::move(now), limit, progress, stop);
}

HistoryEntry ScanHistory::travel(Entries& from, Entries& to, HistoryEntry now, std::size_t limit,
                                 const Progress& progress, const std::stop_token& stop) {
  HistoryEntry entry = from.back();
  bring_back_maps(*entry.session, *entry.tree, entry.at, entry.stand, progress, stop);
  now.change = entry.change, now.is_choice = entry.is_choice;
  from.pop_back();
  to.push_back(std::move(now));
  keep_within(limit, entry.stand.state.get());
  return entry;
}

std::optional<HistoryEntry> ScanHistory::left_in(const std::filesystem::path& folder, const Progress& progress,
                                                 const std::stop_token& stop) const {
  for (const Entries* entries : {&redo_, &undo_})
    for (const HistoryEntry& entry : *entries) {
      if (!entry.kept->is_in(folder)) continue;
      StepTree& tree = *entry.tree;
      HistoryEntry left{entry.session, entry.scanner, entry.kept,           entry.tree,
                        tree.at,       tree.branches, *tree.stand(tree.at), entry.kept->cameras()};
      bring_back_maps(*left.session, tree, left.at, left.stand, progress, stop);
      return left;
    }
  return std::nullopt;
}

std::size_t ScanHistory::gibbs_maps_in_memory_alone() const {
  std::set<const StepTree*> trees;
  for (const Entries* entries : {&redo_, &undo_})
    for (const HistoryEntry& entry : *entries) {
      const bool is_lost = entry.tree->refined.is_in_memory_alone() && !entry.session->planner().needs().posterior;
      if (is_lost && entry.tree != tree_) trees.insert(entry.tree.get());
    }
  return trees.size();
}

void ScanHistory::bring_back_maps(const Session& session, const StepTree& tree, std::uint32_t number,
                                  const Stand& stand, const Progress& progress, const std::stop_token& stop) {
  if (stand.state->has_maps) return;
  const ScanSetup setup = session.setup_with(stand.planning, stop);
  const ScanState* const nearest = tree.nearest_maps(number, stand);
  remake(setup, *stand.state, nearest ? *nearest : nothing_scanned(setup, stand.state->T_world_camera), progress, stop);
}

/// In the order in which they lose their maps: what was undone, other branches, then the oldest.
std::vector<ScanHistory::Held> ScanHistory::held() const {
  std::vector<Held> held;
  std::set<const ScanState*> known;
  const auto add = [&](const Session* session, ScanState* state, const ScanState* neighbour) {
    if (known.insert(state).second) held.push_back({session, state, neighbour});
  };
  const auto add_entries = [&](const Entries& entries) {
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const bool has_neighbour = k + 1 < entries.size() && entries[k + 1].session == entries[k].session;
      add(entries[k].session.get(), entries[k].stand.state.get(),
          has_neighbour ? entries[k + 1].stand.state.get() : nullptr);
    }
  };
  add_entries(redo_);
  std::set<const ScanState*> on_the_way_back;
  for (const HistoryEntry& entry : undo_) on_the_way_back.insert(entry.stand.state.get());
  const auto add_tree = [&](const Session* session, const StepTree& tree) {
    for (const auto& [state, before] : tree.states())
      if (!on_the_way_back.contains(state)) add(session, state, before);
  };
  for (const Entries* entries : {&redo_, &undo_})
    for (const HistoryEntry& entry : *entries) add_tree(entry.session.get(), *entry.tree);
  if (tree_) add_tree(session_.get(), *tree_);
  add_entries(undo_);
  return held;
}

std::size_t ScanHistory::bytes() const {
  std::size_t bytes = 0;
  for (const Held& held : held()) bytes += held.bytes();
  return bytes;
}

void ScanHistory::keep_within(std::size_t limit, const ScanState* now) {
  const std::vector<Held> all = held();
  std::size_t total = 0;
  for (const Held& held : all) total += held.bytes();
  for (const Held& held : all) {
    if (total <= limit) return;
    if (held.state == now || !held.state->has_maps) continue;
    total -= std::min(held.bytes(), total);
    drop_maps(held.session->setup(), *held.state);
  }
}

}  // namespace nextview
