#pragma once
#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "ui/appearance/theme.hpp"
#include "ui/drawing/painter.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

/// Colours of a drawing that do not mean anything.
struct Look {
  Colour paper, ink, soft_ink, hairline;

  static Look light();
  static Look dark();
  /// A series' colour, made lighter on dark paper.
  Colour series(std::size_t i) const;
  Colour on_paper(const Colour& colour) const;
  bool is_dark() const { return ink[0] > paper[0]; }
};

/// A flat drawing as a list of shapes, laid out once and drawn as SVG or as pixels. Places in pixels, the origin in the
/// upper left corner, y down.
class VectorDrawing {
 public:
  VectorDrawing(double width, double height, const Look& look) : width_(width), height_(height), look_(look) {}

  double width() const { return width_; }
  double height() const { return height_; }
  const Look& look() const { return look_; }

  void line(std::vector<Eigen::Vector2d> points, const Colour& colour, double thickness = 1.0, bool dashed = false);
  void line(double x1, double y1, double x2, double y2, const Colour& colour, double thickness = 1.0,
            bool dashed = false) {
    line({{x1, y1}, {x2, y2}}, colour, thickness, dashed);
  }
  /// A convex polygon.
  void area(std::vector<Eigen::Vector2d> corners, const Colour& colour, double opacity = 1.0);
  void box(double x, double y, double width, double height, const Colour& colour, double opacity = 1.0);
  void dot(double x, double y, double radius, const Colour& colour);
  /// (x, y): where the baseline begins, is centred or ends.
  void text(double x, double y, const std::string& words, int size, const Colour& colour,
            TextAlign align = TextAlign::left, bool bold = false);

  std::string svg() const;
  /// Drawn headless (ensure_headless). `scale`: pixels a pixel of the drawing.
  Image image(double scale = 1.0) const;

 private:
  struct Line {
    std::vector<Eigen::Vector2d> points;
    Colour colour;
    double thickness;
    bool dashed;
  };
  struct Area {
    std::vector<Eigen::Vector2d> corners;
    Colour colour;
    double opacity;
  };
  struct Text {
    double x, y;
    std::string words;
    int size;
    Colour colour;
    TextAlign align;
    bool bold;
  };
  class SvgWriter;
  class PixelPainter;

  double width_, height_;
  Look look_;
  std::vector<std::variant<Line, Area, Text>> shapes_;
};

/// About so wide is a text: fonts differ from reader to reader.
double text_width(const std::string& words, int size);

}  // namespace nextview
