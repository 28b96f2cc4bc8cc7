#pragma once
#include "ui/charts/chart.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// How the scan went, view by view: two plots, each of a kind that the user chooses. Earlier runs stay behind, pale.
void draw_curves_panel(const PanelContext& context, const Rectangle& rectangle);

/// A plot's content: the present run, and the earlier ones.
ChartContent curve_content(const SessionSnapshot& session, CurveKind kind);

}  // namespace nextview
