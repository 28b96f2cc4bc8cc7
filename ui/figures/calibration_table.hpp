#pragma once
#include "core/offline/map_calibration.hpp"
#include "ui/charts/page.hpp"

namespace nextview {

/// Of what was before a calibration, and after.
inline constexpr Colour calibration_before = theme::muted, calibration_after = theme::series[0];

/// A panel with a row an example: cross entropy, log loss (also as marks along a line) and open rows, before and after
/// and of the Gibbs map. Made for a panel 1568 pixels wide.
void paint_calibration_table(Painter& painter, const PageArea& panel, const MapCalibration& calibration);

}  // namespace nextview
