#pragma once
#include <optional>

#include "ui/panels/candidates_panel.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// The candidate whose frustum is under a point of the window [px], if any.
std::optional<std::size_t> candidate_at(SceneView& view, const SessionSnapshot& snapshot, double x, double y);

/// Draws over the scene what a person points at or has selected, and the next view if it is no candidate. It costs no
/// new picture of the scene.
void draw_candidate_overlay(SceneView& view, const PanelContext& context, const CandidateFocus& focus);

}  // namespace nextview
