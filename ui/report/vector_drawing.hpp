#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ui/appearance/picture_size.hpp"
#include "ui/appearance/theme.hpp"
#include "ui/drawing/painter.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

class RenderTarget;

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

/// What charts are drawn on: those that can are no wider than it, in letters of the same size.
struct Sheet {
  Sheet(const Look& its_look, double its_width = std::numeric_limits<double>::infinity())
      : look(its_look), width(its_width) {}

  Look look;
  double width;  ///< [px]
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
  /// A picture with its upper left corner at (x, y), pixel by pixel: made for the scale that the drawing is drawn at.
  void picture(double x, double y, Image picture);
  /// (x, y): where the baseline begins, is centred or ends.
  void text(double x, double y, const std::string& words, int size, const Colour& colour,
            TextAlign align = TextAlign::left, bool bold = false);

  /// Whether it is lines and letters alone, which svg() can draw.
  bool is_vector() const;
  /// With a width for print [mm], or in pixels. @pre is_vector()
  std::string svg(std::optional<double> printed_width = {}) const;
  /// Of its letters; none if it has none [px].
  std::optional<int> smallest_text() const;
  /// Drawn in the target, which is as large as it was afterwards. `scale`: pixels a pixel of the drawing.
  Image image(RenderTarget& target, double scale = 1.0) const;
  /// In the middle of a page of this size, as large as it fits.
  Image image(RenderTarget& target, const PictureSize& size) const;
  /// At which it fits there.
  double scale_within(const PictureSize& size) const;

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
  struct Picture {
    double x, y;
    Image image;
  };
  class SvgWriter;
  class PixelPainter;
  Image drawn(RenderTarget& target, const PictureSize& size, double scale) const;

  double width_, height_;
  Look look_;
  std::vector<std::variant<Line, Area, Text, Picture>> shapes_;
};

/// About so wide is a text: fonts differ from reader to reader.
double text_width(const std::string& words, int size);

/// In lines that are no wider than `width`, broken between words.
std::vector<std::string> broken_to(double width, const std::string& words, int size);

}  // namespace nextview
