#pragma once
#include <string>
#include <vector>

#include "ui/appearance/legend.hpp"
#include "ui/drawing/text.hpp"

class vtkContext2D;

namespace nextview {

enum class TextAlign { left, centre, right };

/// Draws flat things, the origin in the lower left corner: text, lines, boxes, legends. All lengths are in pixels of a
/// display of scale 1.
class Painter {
 public:
  /// `scale`: pixels of the display a pixel here; 2 on a HiDPI display.
  /// `dark`: on dark paper, where text, lines, frames and boxes have their colours turned over (on_dark); what
  /// legends show has the colours that it has in the picture.
  explicit Painter(vtkContext2D& context, double scale = 1.0, bool dark = false)
      : context_(context), scale_(scale), dark_(dark) {}

  /// The text's baseline starts (or is centred, or ends) at (x, y).
  void text(double x, double y, const std::string& text, int size, const Colour& colour,
            TextWeight weight = TextWeight::regular, TextAlign align = TextAlign::left);
  double text_width(const std::string& text, int size, TextWeight weight = TextWeight::regular);
  void line(double x1, double y1, double x2, double y2, double width, const Colour& colour);
  void box(double x, double y, double width, double height, const Colour& colour, double opacity = 1.0);
  void frame(double x, double y, double width, double height, const Colour& colour);

  /// Draws a legend whose upper left corner is (x, y); returns its height.
  double legend(double x, double y, const Legend& legend);
  double legend_width(const Legend& legend);
  double bar_width(const Legend::Range& range);
  static double legend_height(const Legend& legend);

 private:
  float px(double length) const { return static_cast<float>(length * scale_); }
  void lock(double x, double y);
  Colour tone(const Colour& colour) const { return dark_ ? on_dark(colour) : colour; }
  void fill(double x, double y, double width, double height, const Colour& colour, double opacity);

  vtkContext2D& context_;
  double scale_;
  bool dark_;
};

/// Of most legends, and of every colour bar [px].
inline constexpr double usual_legend_width = 168.0;

/// "1234", "12.3", "0.00123": four significant digits for people.
std::string short_number(double value);
/// An end of a range, to three digits of how wide that is: what is next to nothing beside it is not spelled out.
std::string range_end(double value, double width);

}  // namespace nextview
