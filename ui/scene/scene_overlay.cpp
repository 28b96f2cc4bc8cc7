#include "ui/scene/scene_overlay.hpp"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkContext2D.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/setting/length_text.hpp"
#include "ui/drawing/painter.hpp"
#include "ui/scene/scene_renderer.hpp"

namespace nextview {
namespace {

constexpr double margin = 16.0;                        // [px]
constexpr double axis_length = 30.0;                   // [px]
constexpr double legend_gap = 14.0;                    // [px]
constexpr double longest_bar = 150.0, min_bar = 24.0;  // [px]

struct Axis {
  const char* name;
  Vector3 in_view;  ///< x right, y up, z towards the viewer
};

std::array<Axis, 3> axes_in_view(vtkCamera& camera) {
  vtkMatrix4x4* view = camera.GetViewTransformMatrix();
  std::array<Axis, 3> axes{{{"x", {}}, {"y", {}}, {"z", {}}}};
  for (int axis = 0; axis < 3; ++axis) {
    for (int row = 0; row < 3; ++row) axes[axis].in_view[row] = view->GetElement(row, axis);
  }
  // The axis that points away from the viewer most is drawn first.
  std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.in_view.z() < b.in_view.z(); });
  return axes;
}

void paint_axes(Painter& painter, vtkCamera& camera) {
  const double x = margin + axis_length + 8, y = margin + axis_length;
  for (const Axis& axis : axes_in_view(camera)) {
    const Eigen::Vector2d tip = axis.in_view.head<2>() * axis_length;
    painter.line(x, y, x + tip.x(), y + tip.y(), 2, theme::ink);
    const Eigen::Vector2d label =
        tip + (tip.norm() > 1 ? Eigen::Vector2d(tip.normalized() * 9) : Eigen::Vector2d::Zero());
    painter.text(x + label.x(), y + label.y() - 8, axis.name, theme::small_text, theme::ink, TextWeight::semi_bold,
                 TextAlign::centre);
  }
}

/// The longest of 1, 2 or 5 times a power of ten that fits.
double round_length(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= longest) return factor * power;
  }
  return power;
}

/// Of the picture [px at scale 1].
Eigen::Vector2d picture_size(vtkRenderer& renderer, double scale) {
  return Eigen::Vector2d(renderer.GetSize()[0], renderer.GetSize()[1]) / scale;
}

constexpr double backing_opacity = 0.72;  // of paper behind what must be legible whatever lies there

void paint_scale_bar(Painter& painter, vtkRenderer& renderer, double scale, const Vector3& reference, bool backed) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 position(camera.GetPosition());
  const double distance = Vector3(camera.GetDirectionOfProjection()).dot(reference - position);
  if (distance <= 0) return;
  const double height = camera.GetParallelProjection()
                            ? 2 * camera.GetParallelScale()
                            : 2 * distance * std::tan(camera.GetViewAngle() * std::numbers::pi / 360);
  const double pixels_per_metre = picture_size(renderer, scale).y() / height;
  const double x = margin + 2 * axis_length + 44, y = margin + 4;
  const double longest = std::min(longest_bar, picture_size(renderer, scale).x() - x - 2 * margin);
  if (longest < min_bar) return;
  const double length = round_length(longest / pixels_per_metre), width = length * pixels_per_metre;
  const std::string text = length_text(length);
  if (backed) {
    const double half = painter.text_width(text, theme::small_text) / 2 + 5;
    painter.box(x + width / 2 - half, y + 4, 2 * half, theme::small_text + 7, theme::sky, backing_opacity);
  }
  painter.line(x, y, x + width, y, 2, theme::ink);
  painter.line(x, y - 4, x, y + 4, 2, theme::ink);
  painter.line(x + width, y - 4, x + width, y + 4, 2, theme::ink);
  painter.text(x + width / 2, y + 6, text, theme::small_text, theme::ink, TextWeight::regular, TextAlign::centre);
}

/// Pixels at scale 1 and how deep it lies, 0 to 1, if no nearer to the camera than what is drawn.
std::optional<Vector3> project_deep(vtkRenderer& renderer, double scale, const Vector3& point) {
  vtkMatrix4x4* projection =
      renderer.GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer.GetTiledAspectRatio(), -1, 1);
  double clip[4] = {point.x(), point.y(), point.z(), 1.0};
  projection->MultiplyPoint(clip, clip);
  if (clip[3] <= 0 || clip[2] < -clip[3]) return {};
  const Eigen::Vector2d size = picture_size(renderer, scale);
  return Vector3((clip[0] / clip[3] + 1) / 2 * size.x(), (clip[1] / clip[3] + 1) / 2 * size.y(),
                 (clip[2] / clip[3] + 1) / 2);
}

std::optional<Eigen::Vector2d> project(vtkRenderer& renderer, double scale, const Vector3& point) {
  const auto pixel = project_deep(renderer, scale, point);
  if (!pixel) return {};
  return Eigen::Vector2d(pixel->head<2>());
}

/// From a place so far towards the viewer.
Vector3 nearer(vtkCamera& camera, const Vector3& place, double way) {
  const Vector3 back = camera.GetParallelProjection() ? Vector3(-Vector3(camera.GetDirectionOfProjection()))
                                                      : Vector3(Vector3(camera.GetPosition()) - place);
  return place + std::min(way, back.norm()) * back.normalized();
}

/// The lower left part of the picture that axes and scale bar take [px].
Eigen::Vector2d corner_size(bool axes, bool scale_bar) {
  return {scale_bar ? margin + 2 * axis_length + 44 + longest_bar : margin + 2 * axis_length + 20,
          axes ? margin + 2 * axis_length + 16 : margin + 24};
}

/// How much of `box` lies on any of `others` [px^2].
double overlap(const Eigen::AlignedBox2d& box, const std::vector<Eigen::AlignedBox2d>& others) {
  double area = 0;
  for (const Eigen::AlignedBox2d& other : others) {
    const Eigen::AlignedBox2d common = box.intersection(other);
    if (!common.isEmpty()) area += common.volume();
  }
  return area;
}

/// Where a label's box may be: beside its place if it can, else left of it, above it or beneath it, or beside what is
/// in its way, as near as it can.
Eigen::AlignedBox2d place_label(const Eigen::Vector2d& place, const Eigen::Vector2d& label, bool above,
                                const Eigen::Vector2d& picture, const std::vector<Eigen::AlignedBox2d>& taken) {
  const double right = place.x() + 6, left = place.x() - label.x() - 6, middle = place.x() - label.x() / 2;
  const double usual = place.y() + (above ? 7 : -9), high = place.y() + 12, low = place.y() - label.y() - 12;
  std::vector<Eigen::AlignedBox2d> boxes;
  const auto try_at = [&](double x, double y) {
    const Eigen::Vector2d farthest = (picture - label).cwiseMax(0) - Eigen::Vector2d(4, 1);
    const Eigen::Vector2d inside = Eigen::Vector2d(x, y).cwiseMin(farthest).cwiseMax(Eigen::Vector2d(0, 1));
    boxes.emplace_back(inside, inside + label);
  };
  try_at(right, usual), try_at(left, usual);
  for (const double y : {high, low}) try_at(middle, y);
  try_at(right, low), try_at(left, low);
  const auto beside = static_cast<std::ptrdiff_t>(boxes.size());
  for (const Eigen::AlignedBox2d& other : taken) {
    try_at(other.min().x() - label.x() - 2, usual), try_at(other.max().x() + 2, usual);
    try_at(right, other.max().y() + 2), try_at(right, other.min().y() - label.y() - 2);
  }
  std::stable_sort(boxes.begin() + beside, boxes.end(), [&](const auto& a, const auto& b) {
    return a.squaredExteriorDistance(place) < b.squaredExteriorDistance(place);
  });
  return *std::ranges::min_element(boxes, {}, [&](const auto& box) { return overlap(box, taken); });
}

/// Paints it clear of what is taken, where it can, and takes its place.
void paint_label(Painter& painter, vtkRenderer& renderer, double scale, const Label& label,
                 std::vector<Eigen::AlignedBox2d>& taken) {
  std::optional<Eigen::Vector2d> place;
  for (const Vector3& candidate : label.places) {
    const auto pixel = project(renderer, scale, candidate);
    if (pixel && (!place || pixel->y() < place->y())) place = pixel;
  }
  if (!place) return;
  const Eigen::Vector2d picture = picture_size(renderer, scale);
  const bool within = Eigen::AlignedBox2d(Eigen::Vector2d::Zero(), picture).contains(*place);
  if (!label.strong && label.places.size() == 1 && !within) return;  // at the border it would name nothing
  const auto weight = label.strong ? TextWeight::semi_bold : TextWeight::regular;
  const Eigen::Vector2d size(painter.text_width(label.text, theme::small_text, weight) + 8, 20);
  const bool above = label.places.size() == 1;  // of several, the lowest was taken: there is room beneath it
  const Eigen::AlignedBox2d box = place_label(*place, size, above, picture, taken);
  painter.box(box.min().x(), box.min().y(), size.x(), size.y(), theme::paper, 0.75);
  painter.text(box.min().x() + 4, box.min().y() + 3, label.text, theme::small_text, label.colour, weight);
  taken.push_back(box);
}

}  // namespace

vtkStandardNewMacro(SceneOverlay);

/// Beneath the caption where that may reach them.
double SceneOverlay::legends_begin() const { return margin + (legend_size < 1 && !caption.empty() ? 24 : 0); }

double SceneOverlay::legends_height() const {
  double height = legends_begin();
  for (const Legend& legend : legends) height += legend_size * (Painter::legend_height(legend) + legend_gap);
  return height;
}

Eigen::Vector2d SceneOverlay::axes_size() const { return corner_size(true, false); }

/// All but those that have not their room: something is before them at three of the four pixels around their place.
std::vector<Label> SceneOverlay::seen_labels() const {
  std::vector<Label> seen;
  std::vector<std::size_t> asked;
  std::vector<Eigen::Vector2d> places;
  std::vector<double> limits;
  for (const Label& label : labels) {
    seen.push_back(label);
    if (!std::isfinite(label.room)) continue;
    const auto place = project(*renderer, scale, label.places.front());
    const auto limit =
        project_deep(*renderer, scale, nearer(*renderer->GetActiveCamera(), label.places.front(), label.room));
    if (!place || !limit) continue;
    asked.push_back(seen.size() - 1);
    places.push_back(scale * *place);
    limits.push_back(limit->z());
  }
  const auto depths = renderer->depths(places);
  for (std::size_t i = depths.size(); i-- > 0;)
    if (std::ranges::count_if(depths[i], [&](float depth) { return depth < limits[i]; }) >= 3)
      seen.erase(seen.begin() + std::ptrdiff_t(asked[i]));
  return seen;
}

bool SceneOverlay::Paint(vtkContext2D* context) {
  Painter painter(*context, scale, dark);
  const Eigen::Vector2d size = picture_size(*renderer, scale);
  Painter legend_painter(*context, scale * legend_size, dark);
  double width = 0;
  for (const Legend& legend : legends) width = std::max(width, legend_size * legend_painter.legend_width(legend));
  legends_reach_ = legends.empty() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(margin + width + 10, legends_height() - 4);
  if (backed && !legends.empty())
    painter.box(size.x() - legends_reach_.x(), size.y() - legends_reach_.y(), width + 20,
                legends_height() - legends_begin() + 4, theme::sky, backing_opacity);
  if (axes) paint_axes(painter, *renderer->GetActiveCamera());
  if (scale_bar) paint_scale_bar(painter, *renderer, scale, scale_reference, backed);
  const double left = size.x() - margin - width;
  std::vector<Eigen::AlignedBox2d> taken;  // by what labels must not cover
  double y = size.y() - legends_begin();
  for (const Legend& legend : legends) {
    const double height = legend_size * Painter::legend_height(legend);
    taken.emplace_back(Eigen::Vector2d(left - 8, y - height - 4), Eigen::Vector2d(size.x(), y));
    y -= height + legend_size * legend_gap;
  }
  if (axes || scale_bar) taken.emplace_back(Eigen::Vector2d(0, 0), corner_size(axes, scale_bar));
  if (!caption.empty()) {
    const double length = painter.text_width(caption, theme::caption, TextWeight::semi_bold);
    taken.emplace_back(Eigen::Vector2d(margin, size.y() - margin - 22), Eigen::Vector2d(margin + length, size.y()));
  }
  for (const Label& label : seen_labels()) paint_label(painter, *renderer, scale, label, taken);
  if (!caption.empty())
    painter.text(margin, size.y() - margin - 18, caption, theme::caption, theme::ink, TextWeight::semi_bold);
  y = size.y() - legends_begin();
  for (const Legend& legend : legends)
    y -= legend_size * (legend_painter.legend(left / legend_size, y / legend_size, legend) + legend_gap);
  return true;
}

}  // namespace nextview
