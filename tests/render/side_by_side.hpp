#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ui/render_target/image.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

struct Panel {
  std::string caption;
  std::function<void(Scene&)> fill;
};

/// Draws scenes beside each other, row by row, each with its caption and legends. Expects that OpenGL reports no error.
Image draw_side_by_side(int width, int height, int columns, const std::vector<Panel>& panels,
                        const ViewDirection& direction = {});

}  // namespace nextview
