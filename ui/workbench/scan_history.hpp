#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "core/session/driver_setup.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/kept_session.hpp"
#include "ui/workbench/seen_surface.hpp"

namespace nextview {

/// Where the window's work stood once.
struct HistoryEntry {
  std::shared_ptr<Session> session;
  TerminationConfig termination;
  PlannerConfig planner;
  ScanState state;
  SeenSurface seen;
  std::shared_ptr<DriverConnection> scanner = {};  ///< null unless it is a live one's
  std::shared_ptr<KeptSession> kept = {};          ///< null if sessions are not kept
  SessionFolder::Line line = {};                   ///< captures that its views are of
};

/// The states to go back to, and those to go forward to again. Their maps take no more memory than a limit: beyond it
/// the oldest lose theirs, and get them again from their scans when they are asked for. Of other sessions a few stay.
class ScanHistory {
 public:
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  /// Something is about to change: `now` can be gone back to. What was undone is forgotten. `limit` in bytes.
  void push(HistoryEntry now, std::size_t limit);
  /// Goes back, or forward; `now` is where the way back then leads. The entry has its maps.
  /// @throws Stopped; then nothing has changed. @pre can_undo(), can_redo()
  HistoryEntry undo(HistoryEntry now, std::size_t limit, const Progress& progress, const std::stop_token& stop);
  HistoryEntry redo(HistoryEntry now, std::size_t limit, const Progress& progress, const std::stop_token& stop);

  /// What the maps of all entries take, what they share counted once [bytes].
  std::size_t bytes() const;

 private:
  using Entries = std::vector<HistoryEntry>;  ///< the nearest last
  HistoryEntry travel(Entries& from, Entries& to, HistoryEntry now, std::size_t limit, const Progress& progress,
                      const std::stop_token& stop);
  void keep_within(std::size_t limit);

  Entries undo_, redo_;
};

}  // namespace nextview
