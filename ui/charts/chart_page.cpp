#include "ui/charts/chart_page.hpp"

#include <algorithm>
#include <deque>

namespace nextview {
namespace {

std::size_t columns_of(std::size_t charts) { return charts > 1 ? 2 : 1; }
std::size_t rows_of(std::size_t charts) { return (charts + columns_of(charts) - 1) / columns_of(charts); }

}  // namespace

PictureSize page_size(std::size_t charts) { return {640 * int(columns_of(charts)), 400 * int(rows_of(charts))}; }

Image draw_charts(RenderTarget& target, std::span<const ChartContent> charts, const PictureSize& size,
                  bool transparent) {
  DrawnApart page(target, {}, size);
  std::deque<Chart> drawn;
  const PictureSize usual = page_size(charts.size());
  const double scale = std::max(1.0, std::min(double(size.width) / usual.width, double(size.height) / usual.height));
  const double width = 1.0 / double(columns_of(charts.size())), height = 1.0 / double(rows_of(charts.size()));
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double left = width * double(i % columns_of(charts.size()));
    const double bottom = 1.0 - height * double(i / columns_of(charts.size()) + 1);
    drawn.emplace_back().attach(target, {left, bottom, left + width, bottom + height});
    drawn.back().set_scale(scale);
    drawn.back().show(charts[i]);
  }
  return page.draw(transparent);
}

}  // namespace nextview
