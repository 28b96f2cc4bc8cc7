#include "ui/window/scene_pointer.hpp"

#include "ui/commands/measure_commands.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/window/camera_control.hpp"

namespace nextview {
namespace {

/// A press that moved less than this before its release is a click [px].
constexpr float click_reach = 4.0f;

}  // namespace

/// The camera follows a drag that began in the scene, also over panels.
bool ScenePointer::drag_camera(SceneView& view) {
  const ImVec2 by = ImGui::GetIO().MouseDelta;
  if (by.x == 0 && by.y == 0) return false;
  (drag_ == Drag::orbit ? orbit : pan)(view.renderer(), view.pivot(), by.x, by.y);
  return true;
}

void ScenePointer::pick(SceneView& view, const PanelContext& context) const {
  const ImGuiIO& io = ImGui::GetIO();
  if (context.window.measurement) {
    const auto point = view.surface_point(io.MousePos.x, io.MousePos.y);
    if (point) context.post(command::measure_point(point->x(), point->y(), point->z()));
    return;
  }
  const Picked picked = view.pick(io.MousePos.x, io.MousePos.y);
  if (picked.candidate) {
    context.post(command::select_view(*picked.candidate));
  } else if (picked.voxel) {
    const Vector3 centre = context.snapshot.grid.centre(*picked.voxel);
    context.post(command::inspect_voxel(centre.x(), centre.y(), centre.z()));
  } else if (picked.ray) {
    context.post(command::inspect_ray(*picked.ray));
  } else {
    context.post(command::clear_selection());
  }
}

bool ScenePointer::follow(SceneView& view, const Rectangle* beside, const PanelContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_scene = !io.WantCaptureMouse && view.rectangle().contains(io.MousePos.x, io.MousePos.y);
  const bool over_camera =
      over_scene || (beside && !io.WantCaptureMouse && beside->contains(io.MousePos.x, io.MousePos.y));
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left),
             middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
  bool moved = false;
  const bool was_dragging = drag_ != Drag::none;
  const bool at_handle = drag_ == Drag::none && region_.follow(view, context);
  if (over_camera && drag_ == Drag::none && !at_handle) {
    const ImVec2 at = io.MousePos;
    if (over_scene && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && view.set_pivot(at.x, at.y)) {
      centre(view.renderer(), view.pivot());
      moved = true;
    } else if (left || middle) {
      if (over_scene) view.set_pivot(at.x, at.y);
      drag_ = left && !io.KeyShift ? Drag::orbit : Drag::pan;
    } else if (over_scene) {
      context.hovered = view.pick(at.x, at.y).candidate;
    }
  }
  if (drag_ != Drag::none) {
    if (was_dragging) moved = drag_camera(view);  // the way to where it was pressed is none of the drag
    if (!io.MouseDown[ImGuiMouseButton_Left] && !io.MouseDown[ImGuiMouseButton_Middle]) {
      const bool click = ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                         io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < click_reach * click_reach;
      if (click && over_scene && !context.window.edit_region) pick(view, context);
      drag_ = Drag::none;
    }
  }
  if (over_camera && io.MouseWheel != 0) {
    if (over_scene) view.set_pivot(io.MousePos.x, io.MousePos.y);
    zoom(view.renderer(), view.pivot(), io.MouseWheel);
    moved = true;
  }
  return moved;
}

}  // namespace nextview
