#include "ui/figures/slice.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/setting/length_text.hpp"
#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

constexpr double legend_height = 58.0, legend_row = 22.0;  // [px]
constexpr double legend_width = 440.0;                     // [px] at least
constexpr double bar_width = 130.0, bar_height = 12.0;     // [px]
constexpr int hatch_spacing = 6;                           // [px]

/// The colours of a value, and their range.
struct Scale {
  ColourMap map;
  double low, high;
  std::string low_text, high_text, unit;
  double fading = 0.0;  ///< share of the range over which the colours come out of the paper's white

  Colour at(double value) const {
    const double share = (value - low) / (high - low);
    return fading > 0.0 ? mix(theme::paper, map.at(share), std::clamp(share / fading, 0.0, 1.0)) : map.at(share);
  }
};

Scale scale_of(SliceValue value) {
  switch (value) {
    case SliceValue::entropy:
      return {ColourMap::contribution(), 0.0, std::numbers::ln2, "0", "0.69", "nats", 0.3};
    case SliceValue::difference:  // the same colours as a probability: towards free, towards occupied
      return {ColourMap::probability(), -1.0, 1.0, "−1", "+1", ""};
    default:
      return {ColourMap::probability(), 0.0, 1.0, "0", "1", ""};
  }
}

double value_of(const SliceContent& content, std::uint32_t voxel) {
  const Voxel& v = content.voxels[voxel];
  if (content.value == SliceValue::entropy) return v.entropy;
  if (content.value == SliceValue::difference) return double(v.probability) - content.other[voxel].probability;
  return v.probability;
}

bool is_measured(const SliceContent& content, std::uint32_t voxel) {
  return content.voxels[voxel].measured || (!content.other.empty() && content.other[voxel].measured);
}

void check(const SliceContent& content) {
  content.slice.check(content.grid);
  const std::size_t voxels = content.grid.voxel_count();
  const bool needs_other = content.value == SliceValue::difference;
  if (content.voxels.size() != voxels || (needs_other && content.other.size() != voxels))
    throw std::invalid_argument(fmt::format("slice '{}': {} and {} voxels for a grid of {}", content.title,
                                            content.voxels.size(), content.other.size(), voxels));
}

Image blank(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 4, 255)};
}

/// `x` to the right and `y` up.
void set_pixel(Image& image, int x, int y, const Colour& colour) {
  std::uint8_t* pixel = &image.rgba[(std::size_t(image.height - 1 - y) * image.width + x) * 4];
  for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
}

Colour hatch(int x, int y) { return mix(theme::paper, theme::soft_ink, (x + y) % hatch_spacing == 0 ? 0.45 : 0.04); }

void set_square(Image& image, int x, int y, int edge, const Colour& colour) {
  const Colour border = edge >= 8 ? mix(colour, theme::paper, 0.3) : colour;
  for (int v = y; v < y + edge; ++v)
    for (int u = x; u < x + edge; ++u) set_pixel(image, u, v, u == x || v == y ? border : colour);
}

Image hatched(int width, int height) {
  Image image = blank(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(image, x, y, hatch(x, y));
  return image;
}

void paint_section(Painter& painter, const SliceContent& content, const PageArea& picture, int edge) {
  const Eigen::Vector2d first(content.slice.left, content.slice.bottom), corner(picture.left, picture.bottom);
  auto pieces = cross_section(*content.object, content.grid, content.slice);
  std::erase_if(pieces, [&](LinePiece& piece) {
    for (Eigen::Vector2d& end : piece) end = corner + edge * (end - first);
    return !clip(piece, picture.box());
  });
  // A pale seam sets the line off from dark voxels.
  for (const LinePiece& p : pieces) painter.line(p[0].x(), p[0].y(), p[1].x(), p[1].y(), 4, theme::paper);
  for (const LinePiece& p : pieces) painter.line(p[0].x(), p[0].y(), p[1].x(), p[1].y(), 2, theme::ink);
}

void paint_label(Painter& painter, const SliceContent& content, const PageArea& picture, int edge,
                 const SliceLabel& label) {
  const Vector3 voxels = (label.place - content.grid.lower()) / content.grid.resolution;
  const Eigen::Vector2d place(picture.left + edge * (voxels[content.slice.right_axis()] - content.slice.left),
                              picture.bottom + edge * (voxels[content.slice.up_axis()] - content.slice.bottom));
  const double width = painter.text_width(label.text, theme::small_text) + 8;
  const PageArea box{std::round(place.x() - 0.5 * width), std::round(place.y() - 10), width, 20};
  if (!picture.box().contains(box.box())) return;
  painter.box(box.left, box.bottom, box.width, box.height, theme::paper, 0.85);
  painter.text(place.x(), box.bottom + 3, label.text, theme::small_text, theme::ink, TextWeight::semi_bold,
               TextAlign::centre);
}

/// What the colours mean; left.
void paint_colours(Painter& painter, double x, double y, const SliceContent& content) {
  const Scale scale = scale_of(content.value);
  const std::string name =
      scale.unit.empty() ? content.value_name : fmt::format("{} [{}]", content.value_name, scale.unit);
  painter.text(x, y + legend_row, name, theme::small_text, theme::ink, TextWeight::semi_bold);
  painter.text(x, y, scale.low_text, theme::small_text, theme::soft_ink);
  const double bar = x + painter.text_width(scale.low_text, theme::small_text) + 8;
  for (int i = 0; i < int(bar_width); ++i)
    painter.box(bar + i, y + 1, 1, bar_height, scale.at(scale.low + (scale.high - scale.low) * i / (bar_width - 1)));
  painter.frame(bar, y + 1, bar_width, bar_height, theme::soft_ink);
  painter.text(bar + bar_width + 8, y, scale.high_text, theme::small_text, theme::soft_ink);
}

/// What is hatched, and the line of the true surface; middle.
void paint_marks(vtkContext2D& context, double x, double y, const SliceContent& content) {
  constexpr int width = 22, height = 13;
  Painter painter(context);
  paint_image(context, x, y + legend_row + 1, hatched(width, height));
  painter.frame(x, y + legend_row + 1, width, height, theme::soft_ink);
  painter.text(x + width + 8, y + legend_row, content.unmeasured_name, theme::small_text, theme::ink);
  if (!content.object) return;
  painter.line(x, y + 7, x + width, y + 7, 2, theme::ink);
  painter.text(x + width + 8, y, "true surface", theme::small_text, theme::ink);
}

/// A round length of at most a fifth of the picture; right.
void paint_scale_bar(Painter& painter, double right, double y, double pixels_per_metre, double picture_width) {
  const double longest = 0.2 * picture_width / pixels_per_metre;
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  const double length = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
  const double left = right - length * pixels_per_metre;
  painter.line(left, y + 4, right, y + 4, 2, theme::ink);
  for (const double end : {left, right}) painter.line(end, y, end, y + 8, 2, theme::ink);
  painter.text(0.5 * (left + right), y + legend_row, length_text(length), theme::small_text, theme::ink,
               TextWeight::regular, TextAlign::centre);
}

}  // namespace

Image slice_squares(const SliceContent& content, int edge) {
  check(content);
  const GridSlice& slice = content.slice;
  const Scale scale = scale_of(content.value);
  Image image = hatched(slice.width * edge, slice.height * edge);
  for (int up = 0; up < slice.height; ++up)
    for (int right = 0; right < slice.width; ++right) {
      const std::uint32_t voxel = slice.voxel(content.grid, right, up);
      if (!is_measured(content, voxel)) continue;
      set_square(image, right * edge, up * edge, edge, scale.at(value_of(content, voxel)));
    }
  return image;
}

void paint_slice(vtkContext2D& context, const PageArea& panel, const SliceContent& content) {
  check(content);
  const GridSlice& slice = content.slice;
  const PageArea room{panel.left + page_margin, panel.bottom + legend_height + page_margin,
                      panel.width - 2 * page_margin, panel.height - legend_height - page_margin - heading_height};
  const int edge = static_cast<int>(std::min(room.width / slice.width, room.height / slice.height));
  if (edge < 1) throw std::invalid_argument(fmt::format("slice '{}': the panel is too small", content.title));

  Painter painter(context);
  const char* axes = "xyz";
  paint_panel(painter, panel, content.title,
              fmt::format("{} = {} · {} right, {} up", axes[slice.axis], length_text(slice.position(content.grid)),
                          axes[slice.right_axis()], axes[slice.up_axis()]));
  PageArea picture{0, 0, double(slice.width) * edge, double(slice.height) * edge};
  picture.left = std::floor(room.left + 0.5 * (room.width - picture.width));
  picture.bottom = std::floor(room.bottom + 0.5 * (room.height - picture.height));
  paint_image(context, picture.left, picture.bottom, slice_squares(content, edge));
  if (content.object) paint_section(painter, content, picture, edge);
  for (const SliceLabel& label : content.labels) paint_label(painter, content, picture, edge, label);
  painter.frame(picture.left - 1, picture.bottom - 1, picture.width + 2, picture.height + 2, theme::soft_ink);

  // As wide as the picture, but never so narrow that its parts meet.
  const double legend = picture.bottom - legend_height, width = std::max(picture.width, legend_width);
  const double left = picture.left + 0.5 * (picture.width - width);
  paint_colours(painter, left, legend, content);
  paint_marks(context, left + 0.45 * width, legend, content);
  paint_scale_bar(painter, left + width, legend, edge / content.grid.resolution, picture.width);
}

}  // namespace nextview
