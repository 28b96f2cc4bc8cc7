#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/journal/branches.hpp"
#include "core/session/saved_session.hpp"
#include "ui/workbench/seen_surface.hpp"
#include "ui/workbench/timeline.hpp"

namespace nextview {

struct GibbsMap;

/// Where a session stands: all that is there again when one comes back.
struct Stand {
  TerminationConfig termination;
  PlanningConfig planning;
  PolicyNeeds needs;                  ///< of its planner
  std::shared_ptr<ScanState> state;   ///< never null; its maps may have been dropped
  std::shared_ptr<SeenSurface> seen;  ///< never null; it may have fewer scans than the state
};

/// The Gibbs map of a session that was asked for last.
struct RefinedMap {
  std::shared_ptr<const GibbsMap> map;             ///< null: none was
  std::vector<std::shared_ptr<const Scan>> scans;  ///< that the session had then
  std::shared_ptr<const GibbsMap> written;         ///< the last one that was exported; null: none was

  bool is_in_memory_alone() const { return map && map != written; }
};

/// Every step that a session has taken, those that it went back from among them, by number; 0 is where nothing was
/// taken yet.
class StepTree {
 public:
  /// @pre nothing is scanned
  StepTree(Stand beginning, const PinholeCamera& camera) : camera_(camera) { nodes_[0].stand = std::move(beginning); }

  std::uint32_t at = 0;  ///< where the session stands
  Branches branches;     ///< it stands on the current one
  RefinedMap refined;    ///< set aside and brought back with the session
  /// What was scanned before the live scanner that the session has, and is gone back to without it; likewise.
  Configuration before_scanner;

  /// What a saved session has taken: it is known from its journal, and taken again where one goes there.
  void add(std::shared_ptr<SavedSession> saved);
  /// The session has taken a step from where it stood, and stands there now. Returns whether that begins a branch.
  bool step(std::uint32_t number, Stand stand);
  /// What there is to come back to at a step that is known.
  void set_stand(std::uint32_t number, Stand stand);
  /// The pictures of the steps that lead to a state, known by number, side by side.
  void take_pictures(std::span<const std::uint32_t> numbers, const ScanState& state);
  /// Brings what was seen up to a step, from what was seen before it. @pre it has a stand
  void follow_seen(std::uint32_t number);
  const std::optional<Stand>& stand(std::uint32_t number) const { return nodes_.at(number).stand; }
  bool has(std::uint32_t number) const { return nodes_.contains(number); }
  std::uint32_t last_number() const { return nodes_.rbegin()->first; }
  /// The branches of another time, with what has come since.
  void go_back_to(const Branches& then);
  /// Numbers from the first step to this one.
  std::vector<std::uint32_t> line(std::uint32_t number) const;
  /// Those at the end of a step's line that would have to be taken again before the session could stand there.
  std::vector<JournalStep> not_here(std::uint32_t number) const;
  /// The number before those.
  std::uint32_t nearest_here(std::uint32_t number) const;
  /// The nearest state before a step, itself included, that has maps as this stand needs them; null if there is none.
  const ScanState* nearest_maps(std::uint32_t number, const Stand& like) const;
  /// Every state that is kept, with the number before it.
  std::vector<std::pair<ScanState*, const ScanState*>> states() const;
  /// The steps were taken by the saved session.
  const std::shared_ptr<SavedSession>& saved() const { return saved_; }

  Timeline timeline() const;

 private:
  struct Node {
    std::uint32_t after = 0;
    std::optional<Stand> stand = {};
    std::shared_ptr<const StepRecord> record = {};   ///< null of 0, and where only the scan is known
    std::shared_ptr<const DepthCells> picture = {};  ///< likewise
  };
  bool leads_through(std::uint32_t tip, std::uint32_t number) const;

  PinholeCamera camera_;  ///< of the pictures
  std::map<std::uint32_t, Node> nodes_;
  std::shared_ptr<SavedSession> saved_;
};

}  // namespace nextview
