#include "tests/render/side_by_side.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "ui/render_target/offscreen_target.hpp"

namespace nextview {

Image draw_side_by_side(int width, int height, int columns, const std::vector<Panel>& panels,
                        const ViewDirection& direction) {
  OffscreenTarget target(width, height);
  std::vector<std::unique_ptr<Scene>> scenes;
  const int rows = (int(panels.size()) + columns - 1) / columns;
  for (int i = 0; i < int(panels.size()); ++i) {
    const double column = i % columns, row = rows - 1 - i / columns;
    scenes.push_back(std::make_unique<Scene>());
    Scene& scene = *scenes.back();
    scene.attach(target, {column / columns, row / rows, (column + 1) / columns, (row + 1) / rows});
    scene.set_caption(panels[std::size_t(i)].caption);
    scene.set_axes(i == 0, i == 0);
    panels[std::size_t(i)].fill(scene);
    scene.frame(direction);
  }
  target.render();
  Image image = target.read_back();
  EXPECT_EQ(target.gl_error(), 0u) << "OpenGL reported an error";
  return image;
}

}  // namespace nextview
