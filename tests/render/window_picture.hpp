#pragma once
#include <filesystem>

#include "ui/render_target/render_target.hpp"

namespace nextview {

/// The picture that is drawn both ways: all layers at once.
Image draw_everything(RenderTarget& target);

/// Draws it in a window on the display and writes it.
void draw_in_window(const std::filesystem::path& png);

}  // namespace nextview
