#include "ui/window/selection_overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ui/appearance/colour_map.hpp"
#include "ui/layers/views_layer.hpp"
#include "ui/panels/view_pictures.hpp"
#include "ui/window/overlay_drawing.hpp"

namespace nextview {
namespace {

using Corners = std::array<std::optional<Eigen::Vector2d>, 4>;

/// Where the corners of a camera's image are in the window, as far from it as the region's middle.
Corners image_corners(SceneView& view, const SessionSnapshot& s, const Pose& T_world_camera) {
  const Vector3 target = 0.5 * (s.grid.lower() + s.grid.upper());
  const double depth = (T_world_camera.translation() - target).norm();
  const PinholeCamera& c = s.camera;
  const double right = c.width - 0.5, bottom = c.height - 0.5;
  const std::array<Eigen::Vector2d, 4> pixels{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 direction = c.direction(pixels[i].x(), pixels[i].y());
    corners[i] = view.project(T_world_camera * Vector3(direction * (depth / direction.z())));
  }
  return corners;
}

/// Who looks through a view sees where its image ends, and how to get away; who stands there, that it sees more.
void draw_image_border(SceneView& view, const PanelContext& context) {
  const SessionSnapshot& s = context.snapshot;
  const Pose seen = selected_view_pose(s, context.window.selection).value_or(s.next_view);
  const Pose& camera = context.window.scene_camera;
  const double depth = frustum_depth(s.candidates, 0.5 * (s.grid.lower() + s.grid.upper()));
  if ((camera.translation() - seen.translation()).norm() > 1e-3 * depth ||
      !camera.linear().isApprox(seen.linear(), 1e-3))
    return;
  const Corners corners = image_corners(view, s, seen);
  const Style& style = context.style;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (std::size_t i = 0; i < 4; ++i)
    if (corners[i] && corners[(i + 1) % 4])
      list.AddLine(at(*corners[i]), at(*corners[(i + 1) % 4]), to_imgui_u32(theme::chosen), style.px(2));
  const Rectangle& r = view.rectangle();
  constexpr double rounding = 2.0;  // [px]
  const Rectangle around{r.x - rounding, r.y - rounding, r.width + 2 * rounding, r.height + 2 * rounding};
  const auto is_shown = [&](const auto& corner) { return corner && around.contains(corner->x(), corner->y()); };
  draw_label(style, {float(r.x) + style.px(8), float(r.y + r.height) - style.px(84)},
             std::ranges::all_of(corners, is_shown) ? "What this view sees. A drag, or F, leaves it."
                                                    : "This view sees more than fits here: look through it (C).",
             theme::chosen);
}

void draw_frustum(SceneView& view, const PanelContext& context, const Pose& T_world_camera, const std::string& label,
                  const Colour& colour) {
  const SessionSnapshot& s = context.snapshot;
  const Vector3 target = 0.5 * (s.grid.lower() + s.grid.upper());
  const Vector3 eye = context.window.scene_camera.translation();
  if (stands_at(eye, T_world_camera.translation(), frustum_depth(s.candidates, target))) return;
  const auto apex = view.project(T_world_camera.translation());
  const Corners base = image_corners(view, s, T_world_camera);
  if (!apex || !std::ranges::all_of(base, [](const auto& corner) { return corner.has_value(); })) return;
  const Style& style = context.style;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 line = to_imgui_u32(colour);
  for (std::size_t i = 0; i < 4; ++i) {
    list.AddTriangleFilled(at(*apex), at(*base[i]), at(*base[(i + 1) % 4]), to_imgui_u32(colour, 0.06));
    list.AddLine(at(*apex), at(*base[i]), line, style.px(1.6f));
    list.AddLine(at(*base[i]), at(*base[(i + 1) % 4]), line, style.px(1.6f));
  }
  list.AddCircleFilled(at(*apex), style.px(4.5f), line);
  const Rectangle& r = view.rectangle();
  draw_label(style, at(*apex), label, colour, r.contains(apex->x(), apex->y()) ? &r : nullptr);
}

std::array<Vector3, 8> corners_of(const VoxelGrid& grid, std::uint32_t voxel) {
  std::array<Vector3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = grid.centre(voxel) + 0.5 * grid.resolution * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return corners;
}

/// Its edges, and the rays that touched it: blue ended in it, grey passed.
void draw_voxel(SceneView& view, const PanelContext& context, std::uint32_t voxel) {
  const SessionSnapshot& s = context.snapshot;
  const float width = context.style.px(1);
  if (const auto& inspected = context.inspection.voxel; inspected && inspected->voxel == voxel) {
    for (const bool hit : {false, true})  // those that ended in it above the others
      for (std::size_t k = 0; k < inspected->rays.size() && k < s.records.size(); ++k)
        for (const VoxelRay& ray : inspected->rays[k])
          if (ray.hit == hit)
            draw_segment(view, s.records[k].T_world_camera.translation(), ray.end.cast<double>(),
                         hit ? to_imgui_u32(theme::series[0], 0.7) : to_imgui_u32(theme::muted, 0.16), width);
  }
  const auto corners = corners_of(s.grid, voxel);
  for (int from = 0; from < 8; ++from)
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(from & axis))
        draw_segment(view, corners[from], corners[from | axis], to_imgui_u32(theme::chosen), 2 * width);
  if (const auto place = view.project(corners[7])) draw_label(context.style, at(*place), "voxel", theme::chosen);
}

/// A ray as a chain of its voxels, in the colour of what it contributes among the view's rays; thicker where it does.
void draw_ray(SceneView& view, const PanelContext& context, std::size_t index) {
  const auto& inspected = context.inspection.view;
  if (!inspected || inspected->view != context.window.selection.view || !inspected->explanation ||
      index >= inspected->explanation->rays.size())
    return;
  const auto& ray = inspected->explanation->rays[index];
  const Vector3 origin = inspected->T_world_camera.translation();
  double largest = 1e-12;
  for (const auto& voxel : ray.voxels) largest = std::max(largest, voxel.contribution);
  const Colour colour =
      ColourMap::contribution().at(ray.contribution, 0, largest_contribution(*inspected->explanation));
  const double edge = context.snapshot.grid.resolution;
  Vector3 from = origin;
  for (const auto& voxel : ray.voxels) {
    const Vector3 centre =
        (Vector3(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) + Vector3::Constant(0.5)) * edge;
    const Vector3 to = origin + ray.direction * ((centre - origin).dot(ray.direction) + 0.5 * edge);
    const double share = voxel.contribution / largest;
    draw_segment(view, from, to, to_imgui_u32(share > 0 ? colour : theme::muted),
                 context.style.px(2.0f + 3.0f * float(std::max(share, 0.0))));
    from = to;
  }
  if (const auto place = view.project(from))
    draw_label(context.style, at(*place), fmt::format("ray {}", index), theme::chosen);
}

using Polyline = std::vector<Vector3>;

Polyline rim_of(const FittedCircle& circle) {
  constexpr int sides = 72;
  const Vector3 u = circle.radius * circle.normal.unitOrthogonal(), v = circle.normal.cross(u);
  Polyline rim;
  for (int k = 0; k <= sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    rim.emplace_back(circle.centre + std::cos(angle) * u + std::sin(angle) * v);
  }
  return rim;
}

/// What is measured comes last: the rim, or the way between two points, or from a plane to a point.
std::vector<Polyline> measured_lines(const Measurement& measurement, const std::optional<FittedCircle>& circle) {
  const Polyline& p = measurement.points;
  if (circle) return {rim_of(*circle)};
  const bool has_plane = measurement.kind == MeasureKind::plane && measurement.complete();
  const auto plane = has_plane ? circle_through(p[0], p[1], p[2]) : std::nullopt;
  if (!plane) return {p};
  const Vector3 foot = p[3] - plane->normal.dot(p[3] - plane->centre) * plane->normal;
  return {{p[0], p[1], p[2], p[0]}, {foot, p[3]}};
}

/// Where the label's line begins: on the rim at its upper right, or in the middle of what is measured.
std::optional<Eigen::Vector2d> label_place(SceneView& view, const Polyline& measured, bool is_rim) {
  if (!is_rim) return view.project(0.5 * (measured.front() + measured.back()));
  std::optional<Eigen::Vector2d> place;
  for (const Vector3& point : measured)
    if (const auto p = view.project(point); p && (!place || p->x() - p->y() > place->x() - place->y())) place = p;
  return place;
}

/// The points that were picked, what is measured by them, and what to click next.
void draw_measurement(SceneView& view, const PanelContext& context, const Measurement& measurement) {
  const Style& style = context.style;
  const auto circle = measured_circle(measurement, context.snapshot.cloud->points);
  const ImU32 colour = to_imgui_u32(theme::chosen);
  const std::vector<Polyline> lines = measured_lines(measurement, circle);
  for (const Polyline& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) draw_segment(view, line[i - 1], line[i], colour, style.px(2));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const Vector3& point : measurement.points)
    if (const auto place = view.project(point)) list.AddCircleFilled(at(*place), style.px(4), colour);
  const Rectangle& r = view.rectangle();
  const ImVec2 corner(float(r.x) + style.px(14), float(r.y + r.height) - style.px(92));
  const Rectangle beside = view.beside_legends()[0];  // what lies beneath them is not seen
  const auto place = measurement.complete() ? label_place(view, lines.back(), circle.has_value()) : std::nullopt;
  const std::string text = measurement.complete() ? measured_text(measurement, circle) : measure_hint(measurement);
  if (place)
    draw_led_label(style, at(*place), text, theme::chosen, beside);
  else
    draw_label(style, corner, text, theme::chosen, &beside);
}

void draw_all(SceneView& view, const PanelContext& context) {
  const SessionSnapshot& s = context.snapshot;
  const Selection& selection = context.window.selection;
  if (s.finished.empty() && s.records.empty() && context.window.layers.views)
    draw_frustum(view, context, s.next_view, "start view", theme::chosen);
  const auto draw = [&](std::size_t candidate) {
    if (candidate >= s.candidates.size() || (candidate == s.next_candidate && s.finished.empty())) return;
    draw_frustum(view, context, s.candidates[candidate], fmt::format("candidate {}", candidate),
                 s.available(candidate) || s.records.empty() ? theme::series[0] : theme::muted);
  };
  if (const auto candidate = selection.candidate()) draw(*candidate);
  if (context.hovered && context.hovered != selection.candidate()) draw(*context.hovered);
  const bool is_next = s.custom_next_view && s.finished.empty();  // which the scene draws itself
  if (selection.view.kind == ViewSelection::Kind::custom && selection.custom_view && !is_next)
    draw_frustum(view, context, *selection.custom_view, "your custom view", theme::series[0]);
  if (selection.view.kind == ViewSelection::Kind::taken && selection.view.index < s.records.size())
    draw_frustum(view, context, s.records[selection.view.index].T_world_camera,
                 fmt::format("view {} as taken", selection.view.index + 1), theme::muted);
  if (selection.voxel && *selection.voxel < s.grid.voxel_count()) draw_voxel(view, context, *selection.voxel);
  if (selection.ray) draw_ray(view, context, *selection.ray);
  draw_image_border(view, context);
  if (context.window.measurement) draw_measurement(view, context, *context.window.measurement);
}

}  // namespace

void draw_selection_overlay(SceneView& view, const PanelContext& context) {
  if (context.snapshot.loaded()) draw_beside_legends(view, [&] { draw_all(view, context); });
}

}  // namespace nextview
