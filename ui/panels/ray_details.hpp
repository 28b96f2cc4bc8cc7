#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// A ray of the view that is looked at: its voxels one by one, and what each contributes to the gain.
void draw_ray_details(const PanelContext& context, const ScoreExplanation& explanation, std::size_t ray);

}  // namespace nextview
