#include "ui/workbench/scan_history.hpp"

#include <set>
#include <utility>

namespace nextview {
namespace {

constexpr std::size_t max_sessions = 4;  ///< in the history: each has a mesh of its own, a ray scene, a truth

/// What the entry at `k` takes beside the one that is nearer to now [bytes].
std::size_t own_bytes(const std::vector<HistoryEntry>& entries, std::size_t k) {
  const bool has_neighbour = k + 1 < entries.size() && entries[k + 1].session == entries[k].session;
  return bytes_of(entries[k].state, has_neighbour ? &entries[k + 1].state : nullptr);
}

std::size_t total_bytes(const std::vector<HistoryEntry>& entries) {
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) bytes += own_bytes(entries, k);
  return bytes;
}

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

/// The state of the same scan that is nearest before this one and has its maps.
ScanState earlier_state(const std::vector<HistoryEntry>& entries, const HistoryEntry& entry) {
  const ScanState* best = nullptr;
  for (const HistoryEntry& e : entries) {
    const auto& scans = e.state.scans;
    const bool before = e.session == entry.session && e.state.has_maps && scans.size() <= entry.state.scans.size() &&
                        std::equal(scans.begin(), scans.end(), entry.state.scans.begin());
    if (before && (!best || scans.size() > best->scans.size())) best = &e.state;
  }
  return best ? *best : nothing_scanned(entry.session->setup(), entry.state.T_world_camera);
}

}  // namespace

void ScanHistory::push(HistoryEntry now, std::size_t limit) {
  redo_.clear();
  undo_.push_back(std::move(now));
  keep_few_sessions(undo_);
  keep_within(limit);
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
  if (!entry.state.has_maps) {
    ScanState earlier = earlier_state(undo_, entry);
    if (&from == &redo_ && earlier_state({now}, entry).scans.size() >= earlier.scans.size())
      earlier = earlier_state({now}, entry);
    remake(entry.session->setup(), entry.state, earlier, progress, stop);
  }
  from.pop_back();
  to.push_back(std::move(now));
  keep_within(limit);
  return entry;
}

std::size_t ScanHistory::bytes() const { return total_bytes(undo_) + total_bytes(redo_); }

void ScanHistory::keep_within(std::size_t limit) {
  std::size_t total = bytes();
  for (Entries* entries : {&redo_, &undo_})  // what was undone goes first
    for (std::size_t k = 0; k < entries->size() && total > limit; ++k) {
      HistoryEntry& entry = (*entries)[k];
      total -= own_bytes(*entries, k);
      if (entry.state.has_maps) drop_maps(entry.session->setup(), entry.state);
    }
}

}  // namespace nextview
