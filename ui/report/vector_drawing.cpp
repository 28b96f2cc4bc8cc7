#include "ui/report/vector_drawing.hpp"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkPen.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/appearance/colour_map.hpp"
#include "ui/appearance/markup.hpp"
#include "ui/charts/page.hpp"

namespace nextview {
Look Look::light() { return {theme::paper, theme::ink, theme::soft_ink, theme::hairline}; }

Look Look::dark() {
  return {theme::from_hex(0x15191F), theme::from_hex(0xE9EDF2), theme::from_hex(0xA3AEBB), theme::from_hex(0x39424E)};
}

Colour Look::series(std::size_t i) const { return on_paper(theme::series[i % theme::series.size()]); }

Colour Look::on_paper(const Colour& colour) const {
  if (!is_dark()) return colour;
  if (colour == theme::ink) return ink;
  // What stays in the background does so on dark paper too.
  return colour == theme::muted ? colour : mix(colour, ink, 0.35);
}

void VectorDrawing::line(std::vector<Eigen::Vector2d> points, const Colour& colour, double thickness, bool dashed) {
  shapes_.emplace_back(Line{std::move(points), colour, thickness, dashed});
}

void VectorDrawing::area(std::vector<Eigen::Vector2d> corners, const Colour& colour, double opacity) {
  shapes_.emplace_back(Area{std::move(corners), colour, opacity});
}

void VectorDrawing::box(double x, double y, double width, double height, const Colour& colour, double opacity) {
  area({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, colour, opacity);
}

void VectorDrawing::dot(double x, double y, double radius, const Colour& colour) {
  std::vector<Eigen::Vector2d> corners;
  constexpr int count = 16;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    corners.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  area(std::move(corners), colour);
}

void VectorDrawing::picture(double x, double y, Image picture) {
  shapes_.emplace_back(Picture{x, y, std::move(picture)});
}

bool VectorDrawing::is_vector() const {
  return std::ranges::none_of(shapes_, [](const auto& shape) { return std::holds_alternative<Picture>(shape); });
}

std::optional<int> VectorDrawing::smallest_text() const {
  std::optional<int> smallest;
  for (const auto& shape : shapes_)
    if (const auto* text = std::get_if<Text>(&shape)) smallest = std::min(smallest.value_or(text->size), text->size);
  return smallest;
}

void VectorDrawing::text(double x, double y, const std::string& words, int size, const Colour& colour, TextAlign align,
                         bool bold) {
  shapes_.emplace_back(Text{x, y, words, size, colour, align, bold});
}

class VectorDrawing::SvgWriter {
 public:
  std::string operator()(const Line& line) const {
    return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{} points=\"{}\"/>\n",
                       markup_colour(line.colour), line.thickness, line.dashed ? " stroke-dasharray=\"5 4\"" : "",
                       list(line.points));
  }
  std::string operator()(const Area& area) const {
    return fmt::format("<polygon fill=\"{}\"{} points=\"{}\"/>\n", markup_colour(area.colour),
                       area.opacity < 1.0 ? fmt::format(" fill-opacity=\"{:g}\"", area.opacity) : "",
                       list(area.corners));
  }
  std::string operator()(const Text& text) const {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
                       text.x, text.y, text.size, markup_colour(text.colour), anchors[int(text.align)],
                       text.bold ? " font-weight=\"600\"" : "", markup_text(text.words));
  }
  std::string operator()(const Picture&) const { return {}; }

 private:
  static std::string list(const std::vector<Eigen::Vector2d>& points) {
    std::string text;
    for (const Eigen::Vector2d& p : points)
      text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", p.x(), p.y());
    return text;
  }
};

std::string VectorDrawing::svg(std::optional<double> printed_width) const {
  const double scale = printed_width ? *printed_width / width_ : 1.0;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{3:g}{5}\" height=\"{4:g}{5}\" viewBox=\"0 0 {0:g} {1:g}\" "
      "font-family=\"Inter, Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"{2}\"/>\n",
      width_, height_, markup_colour(look_.paper), scale * width_, scale * height_, printed_width ? "mm" : "");
  for (const auto& shape : shapes_) svg += std::visit(SvgWriter(), shape);
  return svg + "</svg>\n";
}

class VectorDrawing::PixelPainter {
 public:
  /// The drawing's left end, and its upper end as seen from below [px of the drawing].
  PixelPainter(vtkContext2D& context, double left, double height, double scale)
      : context_(context), painter_(context, scale), left_(left), height_(height), scale_(scale) {}

  void operator()(const Line& line) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      if (line.dashed)
        dashes(line.points[i - 1], line.points[i], line);
      else
        piece(line.points[i - 1], line.points[i], line);
    }
  }
  void operator()(const Area& area) {
    std::vector<float> corners;
    for (const Eigen::Vector2d& p : area.corners) {
      corners.push_back(float((left_ + p.x()) * scale_));
      corners.push_back(float((height_ - p.y()) * scale_));
    }
    const auto channel = [](double value) { return static_cast<unsigned char>(std::lround(255 * value)); };
    context_.GetPen()->SetLineType(vtkPen::NO_PEN);
    context_.GetBrush()->SetColor(channel(area.colour[0]), channel(area.colour[1]), channel(area.colour[2]),
                                  channel(area.opacity));
    context_.DrawPolygon(corners.data(), int(area.corners.size()));
  }
  void operator()(const Picture& picture) {
    paint_image(context_, std::round((left_ + picture.x) * scale_),
                std::round((height_ - picture.y) * scale_) - picture.image.height, picture.image);
  }
  void operator()(const Text& text) {
    // Letters stand on their baseline; VTK places them by their box.
    painter_.text(left_ + text.x, height_ - text.y - 0.22 * text.size, text.words, text.size, text.colour,
                  text.bold ? TextWeight::semi_bold : TextWeight::regular, text.align);
  }

 private:
  void piece(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Line& line) {
    painter_.line(left_ + a.x(), height_ - a.y(), left_ + b.x(), height_ - b.y(), line.thickness, line.colour);
  }
  void dashes(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Line& line) {
    constexpr double on = 5.0, period = 9.0;  // [px]
    const double length = (b - a).norm();
    for (double at = 0.0; at < length; at += period)
      piece(a + (b - a) * at / length, a + (b - a) * std::min(at + on, length) / length, line);
  }

  vtkContext2D& context_;
  Painter painter_;
  double left_, height_, scale_;
};

Image VectorDrawing::drawn(RenderTarget& target, const PictureSize& size, double scale) const {
  const double left = 0.5 * (size.width / scale - width_), top = 0.5 * (size.height / scale - height_);
  return draw_page(target, size, [&](vtkContext2D& context) {
    const auto width = float(size.width), height = float(size.height);
    context.GetPen()->SetLineType(vtkPen::NO_PEN);
    const auto channel = [](double value) { return static_cast<unsigned char>(std::lround(255 * value)); };
    context.GetBrush()->SetColor(channel(look_.paper[0]), channel(look_.paper[1]), channel(look_.paper[2]));
    context.DrawRect(0.0f, 0.0f, width, height);
    PixelPainter painter(context, left, height_ + top, scale);
    for (const auto& shape : shapes_) std::visit(painter, shape);
  });
}

Image VectorDrawing::image(RenderTarget& target, double scale) const {
  const auto pixels = [&](double length) { return int(std::lround(length * scale)); };
  return drawn(target, {pixels(width_), pixels(height_)}, scale);
}

double VectorDrawing::scale_within(const PictureSize& size) const {
  return std::min(size.width / width_, size.height / height_);
}

Image VectorDrawing::image(RenderTarget& target, const PictureSize& size) const {
  return drawn(target, size, scale_within(size));
}

double text_width(const std::string& words, int size) {
  std::size_t letters = 0;
  for (const char c : words) letters += (c & 0xC0) != 0x80;  // of UTF-8
  return 0.55 * size * double(letters);
}

std::vector<std::string> broken_to(double width, const std::string& words, int size) {
  return wrapped(words, [&](const std::string& line) { return text_width(line, size) <= width; });
}

}  // namespace nextview
