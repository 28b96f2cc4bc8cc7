#include "tests/render/side_by_side.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "ui/surface/offscreen_surface.hpp"

namespace nextview {

Image draw_side_by_side(int width, int height, int columns, const std::vector<Panel>& panels,
                        const ViewDirection& direction) {
  OffscreenSurface surface(width, height);
  std::vector<std::unique_ptr<Scene>> scenes;
  const int rows = (int(panels.size()) + columns - 1) / columns;
  for (int i = 0; i < int(panels.size()); ++i) {
    const double column = i % columns, row = rows - 1 - i / columns;
    scenes.push_back(std::make_unique<Scene>());
    Scene& scene = *scenes.back();
    scene.attach(surface, {column / columns, row / rows, (column + 1) / columns, (row + 1) / rows});
    scene.set_caption(panels[std::size_t(i)].caption);
    scene.set_axes(i == 0, i == 0);
    panels[std::size_t(i)].fill(scene);
    scene.frame(direction);
  }
  surface.render();
  Image image = surface.read_back();
  EXPECT_EQ(surface.gl_error(), 0u) << "OpenGL reported an error";
  return image;
}

}  // namespace nextview
