#pragma once
#include "ui/charts/scan_curves.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// How the scan went, view by view: two plots, each of a kind that the user chooses. Earlier runs stay behind, pale.
void draw_curves_panel(const PanelContext& context, const Rectangle& rectangle);

/// What the curves are made of. Points into the snapshot.
ScanCourse scan_course(const SessionSnapshot& session);

/// A plot's content: the present run, and the earlier ones.
ChartContent curve_content(const SessionSnapshot& session, CurveKind kind);

}  // namespace nextview
