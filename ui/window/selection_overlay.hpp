#pragma once
#include "ui/panels/panel.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// Draws over the scene what the user points at or has picked: frustums, a voxel and its rays, a ray and what its
/// voxels contribute. It costs no new picture of the scene.
void draw_selection_overlay(SceneView& view, const PanelContext& context);

}  // namespace nextview
