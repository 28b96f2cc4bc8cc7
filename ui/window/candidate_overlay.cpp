#include "ui/window/candidate_overlay.hpp"

#include <fmt/format.h>

#include <array>

namespace nextview {
namespace {

constexpr double reach = 14.0;          // [px] from a frustum's centre
constexpr double frustum_depth = 0.07;  // [m] as the views layer draws them

void draw_frustum(SceneView& view, const PanelContext& context, const Pose& T_world_camera, const std::string& label,
                  const Colour& colour) {
  const SessionSnapshot& s = context.snapshot;
  const Vector3 target = 0.5 * (s.grid.lower() + s.grid.upper());
  const double depth = (T_world_camera.translation() - target).norm();
  const PinholeCamera& c = s.camera;
  const auto apex = view.project(T_world_camera.translation());
  std::array<std::optional<Eigen::Vector2d>, 4> base;
  const double right = c.width - 0.5, bottom = c.height - 0.5;
  const std::array<Eigen::Vector2d, 4> pixels{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 direction = c.direction(pixels[i].x(), pixels[i].y());
    base[i] = view.project(T_world_camera * Vector3(direction * (depth / direction.z())));
    if (!base[i]) return;
  }
  if (!apex) return;
  const auto at = [](const Eigen::Vector2d& p) { return ImVec2(float(p.x()), float(p.y())); };
  const Style& style = context.style;
  const Rectangle& r = view.rectangle();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({float(r.x), float(r.y)}, {float(r.x + r.width), float(r.y + r.height)});
  const ImU32 line = to_imgui_u32(colour);
  for (std::size_t i = 0; i < 4; ++i) {
    list.AddTriangleFilled(at(*apex), at(*base[i]), at(*base[(i + 1) % 4]), to_imgui_u32(colour, 0.06));
    list.AddLine(at(*apex), at(*base[i]), line, style.px(1.6f));
    list.AddLine(at(*base[i]), at(*base[(i + 1) % 4]), line, style.px(1.6f));
  }
  list.AddCircleFilled(at(*apex), style.px(4.5f), line);
  const ImVec2 size = style.semi_bold->CalcTextSizeA(style.semi_bold->FontSize, FLT_MAX, 0, label.c_str());
  const ImVec2 corner(at(*apex).x + style.px(10), at(*apex).y - size.y - style.px(6));
  list.AddRectFilled({corner.x - style.px(5), corner.y - style.px(2)},
                     {corner.x + size.x + style.px(5), corner.y + size.y + style.px(2)},
                     to_imgui_u32(theme::paper, 0.85), style.px(3));
  list.AddText(style.semi_bold, style.semi_bold->FontSize, corner, line, label.c_str());
  list.PopClipRect();
}

}  // namespace

std::optional<std::size_t> candidate_at(SceneView& view, const SessionSnapshot& snapshot, double x, double y) {
  std::optional<std::size_t> nearest;
  double least = reach;
  for (std::size_t i = 0; i < snapshot.candidates.size(); ++i) {
    const auto pixel = view.project(snapshot.candidates[i] * Vector3(0, 0, 0.5 * frustum_depth));
    const double distance = pixel ? (*pixel - Eigen::Vector2d(x, y)).norm() : reach;
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

void draw_candidate_overlay(SceneView& view, const PanelContext& context, const CandidateFocus& focus) {
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return;
  if (s.finished.empty() && s.records.empty() && !s.next_candidate) {
    draw_frustum(view, context, s.next_view, "start view", theme::chosen);
  }
  const auto draw = [&](std::size_t candidate) {
    if (candidate >= s.candidates.size() || (candidate == s.next_candidate && s.finished.empty())) return;
    draw_frustum(view, context, s.candidates[candidate], fmt::format("view {}", candidate),
                 s.available(candidate) || s.records.empty() ? theme::series[0] : theme::visited);
  };
  if (focus.selected) draw(*focus.selected);
  if (focus.hovered && focus.hovered != focus.selected) draw(*focus.hovered);
}

}  // namespace nextview
