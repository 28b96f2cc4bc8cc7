#pragma once
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "ui/appearance/picture_size.hpp"
#include "ui/drawing/painter.hpp"
#include "ui/render_target/render_target.hpp"

class vtkContext2D;

namespace nextview {

/// A rectangle of a page [px], the origin in the page's lower left corner.
struct PageArea {
  double left = 0.0, bottom = 0.0, width = 0.0, height = 0.0;

  double right() const { return left + width; }
  double top() const { return bottom + height; }
  Eigen::AlignedBox2d box() const { return {Eigen::Vector2d(left, bottom), Eigen::Vector2d(right(), top())}; }
};

/// Between a panel's border and what is in it, and between panels [px]: as in the other figures.
inline constexpr double page_margin = 16.0;
/// What a panel's heading takes off its top [px].
inline constexpr double heading_height = 40.0;

/// A flat picture as large as the target: `paint` draws over a blank page.
Image draw_page(RenderTarget& target, const std::function<void(vtkContext2D&)>& paint);
/// The same of another size; the target is as large as it was afterwards.
Image draw_page(RenderTarget& target, const PictureSize& size, const std::function<void(vtkContext2D&)>& paint);
/// The same, drawn headless (ensure_headless).
Image draw_page(int width, int height, const std::function<void(vtkContext2D&)>& paint);

/// A panel's border, its heading at the left and a remark at the right.
void paint_panel(Painter& painter, const PageArea& panel, const std::string& heading, const std::string& remark = "");

/// A page's title, a remark at the right, and beneath them a caption in as many lines as it needs. Returns the height
/// that they take off the page's top.
double paint_title(Painter& painter, double page_width, double page_height, const std::string& title,
                   const std::string& remark, const std::string& caption);

/// The text in lines that are no wider than `width` [px], broken between words.
std::vector<std::string> wrapped(Painter& painter, const std::string& text, double width, int size);
/// The same in lines that fit, each as long as it can be.
std::vector<std::string> wrapped(const std::string& text, const std::function<bool(const std::string&)>& fits);

/// The picture with its lower left corner at (x, y), pixel by pixel: whole numbers keep it crisp.
void paint_image(vtkContext2D& context, double x, double y, const Image& image);

/// A straight piece of a line.
using LinePiece = std::array<Eigen::Vector2d, 2>;

/// Cuts off what is outside of the box; false if all of it is.
bool clip(LinePiece& piece, const Eigen::AlignedBox2d& box);

}  // namespace nextview
