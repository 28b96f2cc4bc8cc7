#include "ui/window/region_handles.hpp"

#include "core/config/object_lengths.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/window/overlay_drawing.hpp"

namespace nextview {
namespace {

constexpr double handle_reach = 12.0;  // [px] on a display that does not scale
constexpr float handle_radius = 6.0f;  // likewise

/// Of several on one another the one that is nearest to the eye.
std::optional<std::size_t> handle_at(SceneView& view, const Eigen::AlignedBox3d& box, const ImVec2& pointer,
                                     double reach) {
  const Vector3 eye = view.camera_pose().translation();
  std::optional<std::size_t> found;
  for (std::size_t handle = 0; handle < box_handles; ++handle) {
    const Vector3 place = handle_place(box, handle);
    const auto pixel = view.project(place);
    if (!pixel || (*pixel - Eigen::Vector2d(pointer.x, pointer.y)).norm() > reach) continue;
    if (!found || (place - eye).norm() < (handle_place(box, *found) - eye).norm()) found = handle;
  }
  return found;
}

void draw_edges(SceneView& view, const Eigen::AlignedBox3d& box, float width) {
  const std::vector<Vector3> points = corners(box);
  for (std::size_t from = 0; from < 8; ++from)
    for (std::size_t axis = 1; axis < 8; axis *= 2)  // corners differ in one bit along each edge
      if (!(from & axis)) draw_segment(view, points[from], points[from | axis], to_imgui_u32(theme::series[0]), width);
}

}  // namespace

bool RegionHandles::follow(SceneView& view, const PanelContext& context) {
  if (!context.window.edit_region || !context.snapshot.loaded()) {
    *this = {};
    return false;
  }
  if (!drag_ && !context.progress.busy && context.progress.question.empty())
    box_.reset();  // the session has it, or has refused it
  if (drag_)
    drag(view, context);
  else
    begin_or_point(view, context, box_.value_or(context.snapshot.grid.box()));
  return drag_ || pointed_at_;
}

void RegionHandles::begin_or_point(SceneView& view, const PanelContext& context, const Eigen::AlignedBox3d& region) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_scene = !io.WantCaptureMouse && view.rectangle().contains(io.MousePos.x, io.MousePos.y);
  pointed_at_.reset();
  if (over_scene) pointed_at_ = handle_at(view, region, io.MousePos, handle_reach * context.style.scale);
  if (!pointed_at_ || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  drag_ = Drag{*pointed_at_, view.sight(io.MousePos.x, io.MousePos.y), region};
  box_ = region;
}

void RegionHandles::drag(SceneView& view, const PanelContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  box_ = dragged(drag_->start, drag_->handle, drag_->from, view.sight(io.MousePos.x, io.MousePos.y),
                 view.camera_pose().linear().col(2), context.snapshot.grid.resolution);
  if (io.MouseDown[ImGuiMouseButton_Left]) return;
  if (!box_->isApprox(drag_->start)) context.post(command::set("map.region", region_text(*box_)));
  drag_.reset();
}

void RegionHandles::draw(SceneView& view, const PanelContext& context) const {
  if (context.window.edit_region && context.snapshot.loaded())
    draw_beside_legends(view, [&] { draw_box(view, context); });
}

void RegionHandles::draw_box(SceneView& view, const PanelContext& context) const {
  const Style& style = context.style;
  const Rectangle& r = view.rectangle();
  const Eigen::AlignedBox3d box = box_.value_or(context.snapshot.grid.box());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  draw_edges(view, box, style.px(1.6f));
  const auto active = drag_ ? std::optional(drag_->handle) : pointed_at_;
  for (std::size_t handle = 0; handle < box_handles; ++handle) {
    const auto place = view.project(handle_place(box, handle));
    if (!place) continue;
    const float radius = style.px(handle == active ? handle_radius + 2 : handle_radius);
    list.AddCircleFilled(at(*place), radius, to_imgui_u32(handle == active ? theme::chosen : theme::series[0]));
    list.AddCircle(at(*place), radius, to_imgui_u32(theme::paper), 0, style.px(1.5f));
  }
  if (const auto place = view.project(handle_place(box, active.value_or(centre_handle))))
    draw_label(style, at(*place), size_text(box), theme::ink);
  draw_label(style, {float(r.x), float(r.y) + style.px(40)},
             drag_ ? "Let go to start the scan over with this region" : "Drag the region by its handles; Esc leaves",
             theme::ink);
}

}  // namespace nextview
