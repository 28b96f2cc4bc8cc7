#include "ui/panels/inspector_panel.hpp"

#include "ui/panels/ray_details.hpp"
#include "ui/panels/voxel_details.hpp"

namespace nextview {
namespace {

void draw_nothing_picked(const PanelContext& context) {
  heading(context.style, "Nothing is picked");
  small_text(context.style,
             "Click a voxel in the scene: why it has its probability, which rays went through it, what the Gibbs "
             "sampler thinks of it.");
  small_text(context.style,
             "Click a pixel of the lower picture of the View panel, or a ray in the scene: its voxels one by one, and "
             "what each adds to the view's gain.");
}

}  // namespace

void draw_inspector_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Inspector", rectangle, 0, context.style.px(right_panel_width));
  const Selection& selection = context.window.selection;
  const Inspection& inspection = context.inspection;
  if (!context.snapshot.loaded() || (!selection.voxel && !selection.ray)) return draw_nothing_picked(context);
  if (selection.voxel) {
    if (inspection.voxel && inspection.voxel->voxel == *selection.voxel)
      return draw_voxel_details(context, *inspection.voxel);
    return small_text(context.style, "Looking …");
  }
  const auto& view = inspection.view;
  if (!view || view->view != selection.view) return small_text(context.style, "Looking …");
  if (!view->explanation) return small_text(context.style, view->no_explanation);
  if (*selection.ray >= view->explanation->rays.size())
    return small_text(context.style, "The view has no ray of this number.");
  draw_ray_details(context, *view->explanation, *selection.ray);
}

}  // namespace nextview
