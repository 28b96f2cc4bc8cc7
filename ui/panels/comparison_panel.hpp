#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What differs between the branch that the scan is on and another one: settings, and what came of them.
void draw_comparison_panel(const PanelContext& context, const Rectangle& rectangle);

/// A line of it.
struct Difference {
  std::string name, here, there;
};
/// The settings that differ, then what came of both.
std::vector<Difference> differences(const SessionSnapshot& here, const SessionSnapshot& there);

}  // namespace nextview
