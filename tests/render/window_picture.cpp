#include "tests/render/window_picture.hpp"

#include "tests/render/samples.hpp"
#include "ui/render_target/window_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

Image draw_everything(RenderTarget& target) {
  const auto candidates = samples::candidates();
  const auto scores = samples::scores(candidates, samples::usual_viewer);
  const auto map = samples::map(samples::usual_viewer);
  ViewsPicture views;
  views.camera = PinholeCamera::from_field_of_view(640, 480, 1.0123);
  views.candidates = candidates;
  views.scores = scores;
  views.chosen = 17;

  Scene scene;
  scene.attach(target);
  scene.set_caption("Everything at once");
  scene.mesh().show(samples::torus(), MeshStyle::ghost);
  scene.cloud().show(samples::cloud(samples::usual_viewer));
  scene.octree().show(map.grid, map.voxels);
  scene.views().show(views);
  scene.rays().show(samples::rays(candidates[17]), {});
  scene.region().show({map.grid.lower(), map.grid.upper()});
  scene.frame();
  target.render();
  return target.read_back();
}

void draw_in_window(const std::filesystem::path& png) {
  WindowTarget target("Nextview", 960, 600);
  write_png(draw_everything(target), png);
}

}  // namespace nextview
