#pragma once
#include "ui/panels/panel.hpp"
#include "ui/window/scene_view.hpp"
#include "ui/window/shortcuts.hpp"

namespace nextview {

/// What the scene shows. Changes `choice`, which is the window's own business, not the session's.
void draw_layers_panel(PanelContext& context, const Rectangle& rectangle, LayerChoice& choice);

/// The layer that a key switches; null if the action is another.
bool* layer_of(LayerChoice& choice, Action action);

}  // namespace nextview
