#include "ui/workbench/inspection.hpp"

namespace nextview {

std::optional<Pose> looked_at_pose(const SessionSnapshot& s, const Selection& selection) {
  const std::size_t i = selection.view.index;
  switch (selection.view.kind) {
    case LookedAt::Kind::candidate:
      return i < s.candidates.size() ? std::optional(s.candidates[i]) : std::nullopt;
    case LookedAt::Kind::taken:
      return i < s.records.size() ? std::optional(s.records[i].T_world_camera) : std::nullopt;
    case LookedAt::Kind::own:
      return selection.own_view;
    case LookedAt::Kind::next:
      break;
  }
  return s.finished.empty() ? std::optional(s.next_view) : std::nullopt;
}

}  // namespace nextview
