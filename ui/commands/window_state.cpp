#include "ui/commands/window_state.hpp"

namespace nextview {

bool WindowState::shows_guide(const SessionSnapshot& session) const {
  const bool is_begun = !session.records.empty() || !session.finished.empty();  // a map alone is without a view
  return guide_open && (guide_asked || !is_begun);
}

std::string WindowState::in_front(Side side) const {
  const std::string& chosen = front[static_cast<std::size_t>(side)];
  if (!chosen.empty()) return chosen;
  for (const PanelInfo& panel : panel_list())
    if (panel.side == side) return panel.name;
  return "";
}

void WindowState::bring_to_front(const std::string& panel) {
  open = panel_info(panel).side;
  front[static_cast<std::size_t>(open)] = panel;
}

}  // namespace nextview
