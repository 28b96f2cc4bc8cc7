#pragma once
#include "ui/charts/chart.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// Draws a chart's content into a rectangle of the current window: the same ticks and colours as the figures' charts,
/// the values at the pointer besides. Titles, legend and units stand above the plot, where they cover no curve.
void draw_plot(const Style& style, const ChartContent& content, const Rectangle& rectangle);

}  // namespace nextview
