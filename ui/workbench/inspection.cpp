#include "ui/workbench/inspection.hpp"

namespace nextview {

std::optional<Pose> selected_view_pose(const SessionSnapshot& s, const Selection& selection) {
  const std::size_t i = selection.view.index;
  switch (selection.view.kind) {
    case ViewSelection::Kind::candidate:
      return i < s.candidates.size() ? std::optional(s.candidates[i]) : std::nullopt;
    case ViewSelection::Kind::taken:
      return i < s.records.size() ? std::optional(s.records[i].T_world_camera) : std::nullopt;
    case ViewSelection::Kind::custom:
      return selection.custom_view;
    case ViewSelection::Kind::next:
      break;
  }
  return s.finished.empty() ? std::optional(s.next_view) : std::nullopt;
}

}  // namespace nextview
