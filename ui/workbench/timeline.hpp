#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/journal/branches.hpp"
#include "core/session/step_record.hpp"
#include "ui/workbench/depth_cells.hpp"

namespace nextview {

/// A step that a session has taken, wherever it stands now.
struct TimelineStep {
  std::uint32_t number = 0, after = 0;        ///< as in the session's journal; after 0: it is the first
  std::shared_ptr<const StepRecord> record;   ///< without candidates; null where only the scan is known
  std::shared_ptr<const DepthCells> picture;  ///< what was measured; null where the scan is lost
};

/// All steps of a session, and the branches that they are on.
struct Timeline {
  std::vector<TimelineStep> steps;  ///< by number
  Branches branches;
  std::uint32_t at = 0;  ///< the step that the session stands at; 0: before the first

  /// The steps to one of them, the first one first.
  std::vector<const TimelineStep*> line(std::uint32_t number) const;
  /// The steps of a branch.
  std::vector<const TimelineStep*> line(const Branch& branch) const { return line(branch.tip); }
  /// How many views a branch shares with the current one.
  std::size_t in_common(const Branch& branch) const;
};

}  // namespace nextview
