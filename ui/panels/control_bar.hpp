#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// Step, play, reset; what the worker is doing, with a way to stop it; how far the scan is.
/// Returns whether the running job is to be cancelled.
bool draw_control_bar(PanelContext& context, const Rectangle& rectangle);

/// What the buttons do; the keys do the same. Nothing if it is not possible now.
void request_step(PanelContext& context);
void request_play_or_pause(PanelContext& context);
void request_reset(PanelContext& context);

}  // namespace nextview
