#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/session/driver_setup.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/kept_session.hpp"
#include "ui/workbench/step_tree.hpp"

namespace nextview {

/// Where the window's work stood once.
struct HistoryEntry {
  std::shared_ptr<Session> session;
  std::shared_ptr<DriverConnection> scanner;  ///< null unless it is a live one's
  std::shared_ptr<KeptSession> kept;
  std::shared_ptr<StepTree> tree;  ///< of the session
  std::uint32_t at;                ///< the step that it stood at
  Branches branches;
  Stand stand;
  std::vector<CameraBookmark> cameras = {};  ///< that the session kept
  std::optional<NextView> chosen = {};       ///< the operator's own next view; none: the planner's
  bool is_choice = false;                    ///< it differs from what came after it in the next view alone
  std::uint64_t change = 0;                  ///< that was made from there
};

/// The states to go back to, and those to go forward to again. Their maps, and those of all steps of their sessions,
/// take no more memory than a limit: beyond it the oldest lose theirs, and get them again from their scans when they
/// are asked for. Of other sessions a few stay.
class ScanHistory {
 public:
  /// What the maps may take [bytes].
  static std::size_t limit(const Configuration& configuration) {
    constexpr double bytes_per_gibibyte = 1073741824.0;
    return static_cast<std::size_t>(configuration.history.memory * bytes_per_gibibyte);
  }

  /// The session that goes on from here: the maps of its steps count from now on, whether or not undo leads to them.
  void go_on_with(std::shared_ptr<const Session> session, std::shared_ptr<const StepTree> tree) {
    session_ = std::move(session);
    tree_ = std::move(tree);
  }

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// The number of the change that undo would take back; no two have the same. 0: there is none.
  std::uint64_t last_change() const { return undo_.empty() ? 0 : undo_.back().change; }

  /// Something has changed: `before` can be gone back to. What was undone is forgotten. `limit` in bytes; `now` keeps
  /// its maps.
  void push(HistoryEntry before, const ScanState* now, std::size_t limit);
  /// Forgets the last change, which becomes part of the next one; it began here. @pre can_undo()
  HistoryEntry take_last();
  /// Those since the last change of another kind: a view was taken, and undoing it leaves the choice to the planner.
  void forget_choices();
  /// Goes back, or forward; `now` is where the way back then leads. The entry has its maps.
  /// @throws Stopped; then nothing has changed. @pre can_undo(), can_redo()
  HistoryEntry undo(HistoryEntry now, std::size_t limit, const Progress& progress, const std::stop_token& stop);
  HistoryEntry redo(HistoryEntry now, std::size_t limit, const Progress& progress, const std::stop_token& stop);

  /// The session that is kept in this folder, where it stood when it was left; with its maps. None if no state is its.
  /// @throws Stopped
  std::optional<HistoryEntry> left_in(const std::filesystem::path& folder, const Progress& progress,
                                      const std::stop_token& stop) const;

  /// Gibbs maps of sessions that were set aside, in no folder, and not those of a planner, which makes its own anew:
  /// they end with the program.
  std::size_t gibbs_maps_in_memory_alone() const;

  /// The states lose their maps, the oldest first, until they take no more; `now` keeps its own.
  void keep_within(std::size_t limit, const ScanState* now);
  /// What the maps of all states take, what they share counted once [bytes].
  std::size_t bytes() const;
  /// Gives a state its maps again, if they were dropped. @throws Stopped; then it is as it was
  static void bring_back_maps(const Session& session, const StepTree& tree, std::uint32_t number, const Stand& stand,
                              const Progress& progress, const std::stop_token& stop);

 private:
  using Entries = std::vector<HistoryEntry>;  ///< the nearest last
  HistoryEntry travel(Entries& from, Entries& to, HistoryEntry now, std::size_t limit, const Progress& progress,
                      const std::stop_token& stop);
  struct Held;
  std::vector<Held> held() const;

  Entries undo_, redo_;
  std::shared_ptr<const Session> session_;  ///< of now; null before the first; so is the next
  std::shared_ptr<const StepTree> tree_;
  std::uint64_t changes_ = 0;  ///< so far
};

}  // namespace nextview
