#include "tests/render/render_test.hpp"
#include "tests/render/samples.hpp"
#include "tests/render/side_by_side.hpp"
#include "ui/render_target/offscreen_target.hpp"

/// What the window's layers can show, on one page each.
namespace nextview {
namespace {

TEST(Render, octree_colourings) {
  const auto map = samples::map(samples::usual_viewer);
  const auto errors = samples::errors(map), differences = samples::differences(map);
  const auto show = [&](const VoxelFilter& filter, VoxelColouring colouring, std::span<const float> values = {}) {
    return [&map, filter, colouring, values](Scene& scene) {
      scene.octree().show(map.grid, map.voxels, filter, colouring, values);
    };
  };
  VoxelFilter uncertain, slice;
  uncertain.uncertain = true;
  uncertain.entropy_from = 0.55;
  slice.slice = Slice{0, -1.0, 0.06};
  expect_screenshot(
      "octree_colourings",
      draw_side_by_side(1440, 800, 3,
                        {{"By class, cut at x = 60 mm", show(slice, VoxelColouring::by_class)},
                         {"By probability", show({}, VoxelColouring::by_probability)},
                         {"By entropy", show({}, VoxelColouring::by_entropy)},
                         {"Gibbs against conventional", show({}, VoxelColouring::by_difference, differences)},
                         {"Error against the truth", show({}, VoxelColouring::by_error, errors)},
                         {"Uncertain voxels only", show(uncertain, VoxelColouring::by_entropy)}}));
}

TEST(Render, cloud_colourings) {
  const std::vector<Vector3> viewers{
      samples::usual_viewer, {-0.4, -0.9, 0.3}, {0.9, -0.2, -0.3}, {0.1, -0.6, 0.9}, {0.8, 0.7, 0.5}};
  const auto scanned = samples::scanned_cloud(viewers);
  const auto show = [&](CloudColouring colouring) {
    return [&scanned, colouring](Scene& scene) {
      scene.cloud().show({scanned.points, scanned.views, scanned.distances, colouring});
    };
  };
  expect_screenshot("cloud_colourings", draw_side_by_side(1440, 480, 3,
                                                          {{"By view", show(CloudColouring::by_view)},
                                                           {"By height", show(CloudColouring::by_height)},
                                                           {"By distance", show(CloudColouring::by_distance)}}));
}

RENDER_TEST(missed_surface, 960, 600, {
  const auto mesh = samples::torus();
  const auto classes = samples::seen_classes(mesh, {samples::usual_viewer, {-0.4, -0.9, 0.3}});
  const auto hidden = mix(theme::object, theme::ink, 0.55);
  scene.mesh().show(
      mesh, MeshClasses{
                classes, {{"seen", theme::object}, {"missed", theme::missed}, {"cannot be seen", hidden}}, "surface"});
  scene.frame({32, -12});
})

/// All layers, ranges locked, a custom view.
void show_everything(Scene& scene) {
  const auto map = samples::map(samples::usual_viewer);
  const auto candidates = samples::candidates();
  const auto scores = samples::scores(candidates, samples::usual_viewer);
  const std::vector<std::size_t> taken{36, 22};
  const std::vector<Pose> path{look_at(samples::usual_viewer, Vector3::Zero()), candidates[36], candidates[22]};
  const Pose own = look_at(Vector3(-0.75, -0.55, 0.35), Vector3::Zero());
  ViewsPicture views;
  views.camera = PinholeCamera::from_field_of_view(640, 480, 1.0123);
  views.candidates = candidates;
  views.scores = scores;
  views.taken = taken;
  views.path = path;
  views.numbered_path = true;
  views.custom_view = own;
  views.reach = own.translation().norm();
  views.score_name = "utility";
  views.score_unit = "nats";
  views.range = ValueRange{0.0, 2000.0};
  scene.mesh().show(samples::torus(), MeshStyle::ghost);
  scene.octree().show(map.grid, map.voxels, {}, VoxelColouring::by_entropy);
  scene.cloud().show({samples::cloud(samples::usual_viewer)});
  scene.views().show(views);
  scene.rays().show(samples::rays(own), {"contribution of a ray", "nats", 0.5});
  scene.region().show({map.grid.lower(), map.grid.upper()});
  scene.frame();
}

/// As large as in the window.
RENDER_TEST(scene_of_the_window, 675, 490, { show_everything(scene); })

/// The same on a HiDPI display, made as small again: each pixel is the mean of four.
Image halved(const Image& large) {
  Image small{large.width / 2, large.height / 2, {}};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        const auto at = [&](int dx, int dy) {
          return int(large.rgba[(std::size_t(2 * y + dy) * large.width + 2 * x + dx) * 4 + c]);
        };
        small.rgba.push_back(std::uint8_t((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4));
      }
    }
  }
  return small;
}

TEST(HiDpi, TheSceneLooksTheSameTwiceAsFine) {
  OffscreenTarget target(675, 490), fine_target(1350, 980);
  const Image usual = draw_scene(target, show_everything);
  const auto fine = [&](double scale) {
    return halved(draw_scene(fine_target, [scale](Scene& scene) {
      scene.set_scale(scale);
      show_everything(scene);
    }));
  };
  const double scaled = compare(usual, fine(2.0)).changed_share, unscaled = compare(usual, fine(1.0)).changed_share;
  EXPECT_LT(scaled, 0.5 * unscaled) << "text and lines are not as large as at a scale of 1";
  EXPECT_EQ(usual, draw_scene(target, [](Scene& scene) {
              show_everything(scene);
              scene.set_scale(2.0);
              scene.set_scale(1.0);
              scene.frame();
            }));
}

}  // namespace
}  // namespace nextview
