#include "ui/panels/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

constexpr std::size_t max_dots = 40;  ///< of a series: more would be a thick line

ImU32 series_colour(std::size_t index) { return to_imgui_u32(theme::series[index % theme::series.size()]); }

ImU32 earlier_colour() { return to_imgui_u32(mix(theme::muted, theme::paper, 0.55)); }

/// What is drawn where: data coordinates and the pixels of the plot's area.
struct Axes {
  std::vector<double> x_ticks, y_ticks;
  ImVec2 lower_left, upper_right;  ///< [px], y downwards

  Axes(const ChartContent& content, ImVec2 from, ImVec2 to) : lower_left(from), upper_right(to) {
    double x_high = 1.0, y_low = 0.0, y_high = content.y_high.value_or(0.0);
    for (const ChartSeries& series : content.series) {
      for (const double x : series.x) x_high = std::max(x_high, x);
      for (const double y : series.y) y_low = std::min(y_low, y);
      for (const double y : series.y) y_high = std::max(y_high, y);
    }
    x_ticks = round_ticks(0.0, x_high, std::clamp(int((to.x - from.x) / (2.4f * ImGui::GetFontSize())), 2, 10),
                          content.whole_x);
    y_ticks = round_ticks(y_low, y_high, 4, false);
  }

  float x(double value) const {
    const double share = (value - x_ticks.front()) / (x_ticks.back() - x_ticks.front());
    return lower_left.x + float(share) * (upper_right.x - lower_left.x);
  }
  float y(double value) const {
    const double share = (value - y_ticks.front()) / (y_ticks.back() - y_ticks.front());
    return lower_left.y + float(share) * (upper_right.y - lower_left.y);
  }
  bool contains(ImVec2 p) const {
    return p.x >= lower_left.x && p.x <= upper_right.x && p.y <= lower_left.y && p.y >= upper_right.y;
  }
};

/// Height of the title, if there is one.
float title_height(const Style& style, const ChartContent& content) {
  return content.title.empty() ? 0.0f : style.semi_bold->FontSize + style.px(4);
}

/// As many as there is room for up to `right`, the last one maybe shortened.
void draw_captions(const Style& style, const ChartContent& content, ImVec2 corner, float right) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(style.semi_bold, style.semi_bold->FontSize, corner, to_imgui_u32(theme::ink), content.title.c_str());
  float x = corner.x;
  const float y = corner.y + title_height(style, content), size = style.small->FontSize;
  const float mark = style.px(21), least = style.px(40);
  const auto width = [&](const std::string& name) {
    return mark + style.small->CalcTextSizeA(size, FLT_MAX, 0, name.c_str()).x;
  };
  const bool others = !content.series.empty() && content.series.back().earlier;
  const std::size_t named = std::min<std::size_t>(content.series.size(), 5);  // more have no room
  float gap = style.px(14), all = x + (others ? width("others") : -gap);
  for (std::size_t i = 0; i < named && !content.series[i].earlier; ++i) all += width(content.series[i].name) + gap;
  if (all > right) gap = style.px(7);
  const float room = right - (others ? gap + width("others") : 0);
  const auto caption = [&](const std::string& whole, ImU32 colour, bool dot) {
    ImGui::PushFont(style.small);
    const std::string name = shortened(whole, (dot ? room : right) - x - mark);
    ImGui::PopFont();
    list.AddLine({x, y + size / 2}, {x + style.px(16), y + size / 2}, colour, style.px(2));
    if (dot) list.AddCircleFilled({x + style.px(8), y + size / 2}, style.px(3), colour);
    list.AddText(style.small, size, {x + mark, y}, to_imgui_u32(theme::soft_ink), name.c_str());
    x += width(name) + gap;
  };
  for (std::size_t i = 0; i < named && !content.series[i].earlier && room - x > mark + least; ++i)
    caption(content.series[i].name, series_colour(i), true);
  if (others) caption("others", earlier_colour(), false);
}

void draw_grid(const Style& style, const ChartContent& content, const Axes& axes) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 grid = to_imgui_u32(theme::hairline), ink = to_imgui_u32(theme::soft_ink);
  const float size = style.small->FontSize, gap = style.px(5), clear_of_dots = style.px(8);
  const auto width = [&](const std::string& text) {
    return style.small->CalcTextSizeA(size, FLT_MAX, 0, text.c_str()).x;
  };
  for (const double tick : axes.y_ticks) {
    const std::string text = fmt::format("{:g}", std::abs(tick) < 1e-12 ? 0.0 : tick);
    const float y = std::round(axes.y(tick));
    list.AddLine({axes.lower_left.x, y}, {axes.upper_right.x, y}, grid);
    list.AddText(style.small, size, {axes.lower_left.x - clear_of_dots - width(text), y - size / 2}, ink, text.c_str());
  }
  for (const double tick : axes.x_ticks) {
    const std::string text = fmt::format("{:g}", tick);
    const float x = std::round(axes.x(tick));
    list.AddLine({x, axes.lower_left.y}, {x, axes.upper_right.y}, grid);
    list.AddText(style.small, size, {x - width(text) / 2, axes.lower_left.y + gap - style.px(2)}, ink, text.c_str());
  }
  list.AddLine(axes.lower_left, {axes.upper_right.x, axes.lower_left.y}, ink);
  list.AddLine(axes.lower_left, {axes.lower_left.x, axes.upper_right.y}, ink);
  list.AddText(style.small, size, {axes.upper_right.x + style.px(12), axes.lower_left.y + gap - style.px(2)}, ink,
               content.x_label.c_str());
}

/// Whether a series that is drawn later has a point where this one's i-th is.
bool is_covered(const Style& style, const ChartContent& content, std::size_t series, std::size_t i, const Axes& axes) {
  const ChartSeries& own = content.series[series];
  return std::any_of(content.series.begin() + std::ptrdiff_t(series) + 1, content.series.end(), [&](const auto& later) {
    return !later.earlier && i < later.x.size() && later.x[i] == own.x[i] &&
           std::abs(axes.y(later.y[i]) - axes.y(own.y[i])) < style.px(1.5f);
  });
}

void draw_one_series(const Style& style, const ChartContent& content, std::size_t s, const Axes& axes) {
  const ChartSeries& series = content.series[s];
  const ImU32 colour = series.earlier ? earlier_colour() : series_colour(s);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const ImVec2 point(axes.x(series.x[i]), axes.y(series.y[i]));
    if (i > 0)
      list.AddLine({axes.x(series.x[i - 1]), axes.y(series.y[i - 1])}, point, colour,
                   style.px(series.earlier ? 1.2f : 1.8f));
    if (series.earlier || series.x.size() > max_dots) continue;
    // Beneath another's dot it shows as a ring: of two curves that are one, neither is lost.
    list.AddCircleFilled(point, style.px(is_covered(style, content, s, i, axes) ? 4.6f : 2.6f), colour);
  }
}

void draw_series(const Style& style, const ChartContent& content, const Axes& axes) {
  for (const bool earlier : {true, false})
    for (std::size_t s = 0; s < content.series.size(); ++s)
      if (content.series[s].earlier == earlier) draw_one_series(style, content, s, axes);
}

void draw_values_at(const Style& style, const ChartContent& content, const Axes& axes, ImVec2 pointer) {
  const std::vector<double>& xs = content.series[0].x;
  const auto nearest = std::min_element(xs.begin(), xs.end(), [&](double a, double b) {
    return std::abs(axes.x(a) - pointer.x) < std::abs(axes.x(b) - pointer.x);
  });
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = std::round(axes.x(*nearest));
  list.AddLine({x, axes.lower_left.y}, {x, axes.upper_right.y}, to_imgui_u32(theme::soft_ink));
  std::string text = fmt::format("{} {:g}", content.x_label, *nearest);
  for (std::size_t s = 0; s < content.series.size(); ++s) {
    const ChartSeries& series = content.series[s];
    const auto same_x = std::find(series.x.begin(), series.x.end(), *nearest);
    if (same_x == series.x.end()) continue;
    const double value = series.y[static_cast<std::size_t>(same_x - series.x.begin())];
    if (!series.earlier) list.AddCircleFilled({x, axes.y(value)}, style.px(4.5f), series_colour(s));
    text += fmt::format("\n{}: {:.4g} {}", series.name, value, content.y_unit);
  }
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void draw_plot(const Style& style, const ChartContent& content, const Rectangle& r) {
  const float top = title_height(style, content) + style.small->FontSize + style.px(12);
  const float left = style.px(38), right = style.px(48), bottom = style.small->FontSize + style.px(4);
  if (r.width < left + right + style.px(20) || r.height < top + bottom + style.px(20)) return;  // no room to read it
  draw_captions(style, content, {float(r.x), float(r.y)}, float(r.x + r.width));
  const Axes axes(content, {float(r.x) + left, float(r.y + r.height) - bottom},
                  {float(r.x + r.width) - right, float(r.y) + top});
  draw_grid(style, content, axes);
  draw_series(style, content, axes);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  if (!content.series.empty() && !content.series[0].x.empty() && ImGui::IsWindowHovered() && axes.contains(pointer)) {
    draw_values_at(style, content, axes, pointer);
  }
}

}  // namespace nextview
