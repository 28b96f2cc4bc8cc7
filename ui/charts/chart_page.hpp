#pragma once
#include <span>
#include <string>

#include "ui/charts/chart.hpp"
#include "ui/render_target/drawn_apart.hpp"

namespace nextview {

// Charts on one page, two beside each other.

/// As pixels. On a page that is larger than usual letters and lines are larger, too.
Image draw_charts(RenderTarget& target, std::span<const ChartContent> charts, const PictureSize& size,
                  bool transparent);

/// As an SVG drawing: of each series a line (`polyline`), and a dot with its numbers at each value.
/// @throws std::invalid_argument naming the series if its x and y differ in number
std::string charts_svg(std::span<const ChartContent> charts, const PictureSize& size, bool transparent);

/// That charts are made for, a bit over 600 x 375 pixels each.
PictureSize page_size(std::size_t charts);

}  // namespace nextview
