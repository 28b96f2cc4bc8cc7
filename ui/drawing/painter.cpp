#include "ui/drawing/painter.hpp"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

unsigned char channel(double value) { return static_cast<unsigned char>(std::lround(value * 255)); }

constexpr double legend_line = 20.0, swatch_size = 13.0, bar_height = 12.0;  // [px]
constexpr double lock_width = 9.0, lock_gap = 7.0;                           // [px]

std::string title_of(const Legend& legend) {
  const bool has_unit = legend.range && !legend.range->unit.empty();
  return has_unit ? fmt::format("{} [{}]", legend.title, legend.range->unit) : legend.title;
}

std::string named(const std::string& number, const std::string& name) {
  return name.empty() ? number : number + " " + name;
}

}  // namespace

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

std::string range_end(double value, double width) {
  const double digits = 2.0 - std::floor(std::log10(width));
  if (!(digits >= 0.0 && digits <= 6.0)) return short_number(value);
  const double unit = std::pow(10.0, -digits);
  return short_number(std::round(value / unit) * unit + 0.0);  // 0 has no sign
}

void Painter::text(double x, double y, const std::string& text, int size, const Colour& colour, TextWeight weight,
                   TextAlign align) {
  vtkTextProperty& property = *context_.GetTextProp();
  set_text(property, int(std::lround(size * scale_)), tone(colour), weight);
  property.SetJustification(align == TextAlign::left     ? VTK_TEXT_LEFT
                            : align == TextAlign::centre ? VTK_TEXT_CENTERED
                                                         : VTK_TEXT_RIGHT);
  property.SetVerticalJustificationToBottom();
  context_.DrawString(std::round(px(x)), std::round(px(y)), text.c_str());
}

double Painter::text_width(const std::string& text, int size, TextWeight weight) {
  set_text(*context_.GetTextProp(), int(std::lround(size * scale_)), theme::ink, weight);
  float bounds[4];
  context_.ComputeStringBounds(text.c_str(), bounds);
  return bounds[2] / scale_;
}

void Painter::line(double x1, double y1, double x2, double y2, double width, const Colour& meant) {
  const Colour colour = tone(meant);
  context_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
  context_.GetPen()->SetColor(channel(colour[0]), channel(colour[1]), channel(colour[2]), 255);
  context_.GetPen()->SetWidth(px(width));
  context_.DrawLine(px(x1), px(y1), px(x2), px(y2));
}

void Painter::box(double x, double y, double width, double height, const Colour& colour, double opacity) {
  fill(x, y, width, height, tone(colour), opacity);
}

void Painter::fill(double x, double y, double width, double height, const Colour& colour, double opacity) {
  context_.GetPen()->SetLineType(vtkPen::NO_PEN);
  context_.GetBrush()->SetColor(channel(colour[0]), channel(colour[1]), channel(colour[2]), channel(opacity));
  context_.DrawRect(px(x), px(y), px(width), px(height));
}

void Painter::frame(double x, double y, double width, double height, const Colour& colour) {
  line(x, y, x + width, y, 1, colour);
  line(x, y + height, x + width, y + height, 1, colour);
  line(x, y, x, y + height, 1, colour);
  line(x + width, y, x + width, y + height, 1, colour);
}

/// A padlock whose lower left corner is (x, y).
void Painter::lock(double x, double y) {
  constexpr double body = 6.5, shackle = 4.5;  // heights [px]
  box(x, y, lock_width, body, theme::soft_ink);
  line(x + 2, y + body, x + 2, y + body + shackle, 1.5, theme::soft_ink);
  line(x + lock_width - 2, y + body, x + lock_width - 2, y + body + shackle, 1.5, theme::soft_ink);
  line(x + 1.25, y + body + shackle, x + lock_width - 1.25, y + body + shackle, 1.5, theme::soft_ink);
}

/// As wide as usual, or as the names of its ends need beside each other and the 0 between them.
double Painter::bar_width(const Legend::Range& range) {
  const auto& [map, low, high, unit, low_name, high_name] = range;
  constexpr double gap = 10.0;
  const double left = text_width(named(range_end(low, high - low), low_name), theme::small_text),
               right = text_width(named(range_end(high, high - low), high_name), theme::small_text);
  const bool has_middle = low < 0.0 && low == -high;
  const double names = has_middle ? 2 * std::max(left, right) + text_width("0", theme::small_text) + gap : left + right;
  return std::max(usual_legend_width, std::ceil(names + gap));
}

double Painter::legend_width(const Legend& legend) {
  const double title = text_width(title_of(legend), theme::small_text, TextWeight::semi_bold);
  const double bar = legend.range ? bar_width(*legend.range) : usual_legend_width;
  double width = std::max(bar, title + (legend.locked ? lock_gap + lock_width : 0.0));
  for (const Legend::Swatch& swatch : legend.swatches) {
    width = std::max(width, swatch_size + 8 + text_width(swatch.name, theme::small_text));
  }
  return width;
}

double Painter::legend_height(const Legend& legend) {
  const double lines = double(legend.swatches.size()) + (legend.title.empty() ? 0 : 1) + (legend.range ? 1 : 0);
  return lines * legend_line + (legend.range ? bar_height + 3 : 0);
}

double Painter::legend(double x, double y, const Legend& legend) {
  double at = y;
  if (!legend.title.empty()) {
    at -= legend_line;
    text(x, at, title_of(legend), theme::small_text, theme::ink, TextWeight::semi_bold);
    if (legend.locked)
      lock(x + text_width(title_of(legend), theme::small_text, TextWeight::semi_bold) + lock_gap, at + 2);
  }
  for (const Legend::Swatch& swatch : legend.swatches) {
    at -= legend_line;
    fill(x, at + 1, swatch_size, swatch_size, swatch.colour, 1.0);
    for (double from = 4; swatch.stripes && from < 2 * swatch_size; from += 5) {
      const double low = std::max(0.0, from - swatch_size), high = std::min(from, swatch_size);
      line(x + low, at + 1 + swatch_size - high, x + high, at + 1 + swatch_size - low, 1, *swatch.stripes);
    }
    frame(x, at + 1, swatch_size, swatch_size, mix(swatch.colour, theme::ink, 0.3));
    text(x + swatch_size + 8, at, swatch.name, theme::small_text, theme::ink);
  }
  if (legend.range) {
    at -= bar_height + 5;
    const double width = bar_width(*legend.range);
    for (int i = 0; i < int(width); ++i) {
      fill(x + i, at, 1, bar_height, legend.range->map.at(i / (width - 1)), 1.0);
    }
    frame(x, at, width, bar_height, theme::soft_ink);
    at -= legend_line - 2;
    const auto& [map, low, high, unit, low_name, high_name] = *legend.range;
    text(x, at, named(range_end(low, high - low), low_name), theme::small_text, theme::soft_ink);
    if (low < 0.0 && low == -high)
      text(x + 0.5 * width, at, "0", theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::centre);
    text(x + width, at, named(range_end(high, high - low), high_name), theme::small_text, theme::soft_ink,
         TextWeight::regular, TextAlign::right);
  }
  return legend_height(legend);
}

}  // namespace nextview
