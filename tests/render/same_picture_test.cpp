#include "tests/render/render_test.hpp"
#include "tests/render/samples.hpp"
#include "ui/render_target/offscreen_target.hpp"

/// Ways to say the same must draw the same. These need no screenshots, and so none can be wrong.
namespace nextview {
namespace {

void show_map(Scene& scene, VoxelColouring colouring) {
  const auto map = samples::map(samples::usual_viewer);
  scene.octree().show(map.grid, map.voxels, {}, colouring);
}

TEST(SamePicture, AHiddenLayerIsAsIfNeverShown) {
  OffscreenTarget target(320, 200);
  const Image never = draw_scene(target, [](Scene& scene) {
    scene.mesh().show(samples::torus());
    scene.frame();
  });
  const Image hidden = draw_scene(target, [](Scene& scene) {
    scene.mesh().show(samples::torus());
    scene.rays().show(samples::rays(look_at(samples::usual_viewer, Vector3::Zero())), {});
    scene.region().show({Vector3::Constant(-0.5), Vector3::Constant(0.5)});
    scene.rays().set_visible(false);
    scene.region().set_visible(false);
    scene.frame();
  });
  EXPECT_EQ(never, hidden);
}

TEST(SamePicture, ShowingAgainReplacesWhatWasShown) {
  OffscreenTarget target(320, 200);
  const Image once = draw_scene(target, [](Scene& scene) {
    show_map(scene, VoxelColouring::by_class);
    scene.cloud().show({{0.0f, 0.0f, 0.1f}});
    scene.frame();
  });
  const Image again = draw_scene(target, [](Scene& scene) {
    scene.cloud().show(samples::cloud(samples::usual_viewer));
    show_map(scene, VoxelColouring::by_probability);
    show_map(scene, VoxelColouring::by_class);
    scene.cloud().show({{0.0f, 0.0f, 0.1f}});
    scene.frame();
  });
  EXPECT_EQ(once, again);
}

TEST(SamePicture, ColouringAndStyleCanChangeLater) {
  OffscreenTarget target(320, 200);
  const Image at_once = draw_scene(target, [](Scene& scene) {
    show_map(scene, VoxelColouring::by_probability);
    scene.mesh().show(samples::torus(), MeshStyle::ghost);
    scene.frame();
  });
  const Image later = draw_scene(target, [](Scene& scene) {
    show_map(scene, VoxelColouring::by_class);
    scene.octree().set_colouring(VoxelColouring::by_probability);
    scene.mesh().show(samples::torus(), MeshStyle::wire);
    scene.mesh().set_style(MeshStyle::ghost);
    scene.frame();
  });
  EXPECT_EQ(at_once, later);
}

/// Everything, moved by so many voxels along each axis; the camera is framed anew, and so moves along.
Image draw_moved(RenderTarget& target, const Eigen::Vector3i& voxels) {
  return draw_scene(target, [&](Scene& scene) {
    auto map = samples::map(samples::usual_viewer);
    map.grid.first += voxels;
    const Vector3 by = voxels.cast<double>() * map.grid.resolution;
    TriangleMesh torus = samples::torus();
    for (auto& vertex : torus.vertices) vertex += by.cast<float>();
    PointCloud cloud = samples::cloud(samples::usual_viewer);
    for (auto& point : cloud) point += by.cast<float>();
    auto rays = samples::rays(look_at(samples::usual_viewer, Vector3::Zero()));
    for (RaySegment& ray : rays) ray.from += by, ray.to += by;
    scene.mesh().show(torus, MeshStyle::ghost);
    scene.cloud().show(cloud);
    scene.octree().show(map.grid, map.voxels);
    scene.rays().show(rays, {});
    scene.region().show({map.grid.lower(), map.grid.upper()});
    scene.frame();
  });
}

TEST(SamePicture, WhatIsMovedWithItsCameraLooksTheSame) {
  OffscreenTarget target(480, 300);
  const Image here = draw_moved(target, {0, 0, 0});
  for (const Eigen::Vector3i& by : {Eigen::Vector3i(100, 0, 0), {-30, 70, 20}}) {
    const PictureDifference difference = compare(here, draw_moved(target, by));
    // Coordinates are floats: edges may fall into the pixel beside.
    EXPECT_TRUE(difference.within({0.01, 255, "farther from the origin, floats are coarser"})) << difference.summary();
  }
  EXPECT_FALSE(compare(here, draw_scene(target, [](Scene& scene) { scene.frame(); })).within({})) << "nothing is seen";
}

TEST(SamePicture, AnotherColouringIsAnotherPicture) {
  OffscreenTarget target(320, 200);
  const auto draw = [&](VoxelColouring colouring) {
    return draw_scene(target, [=](Scene& scene) {
      show_map(scene, colouring);
      scene.set_legends(false);  // which differ in any case
      scene.frame();
    });
  };
  EXPECT_NE(draw(VoxelColouring::by_class), draw(VoxelColouring::by_probability));
}

TEST(SamePicture, RoughEdgesWhileMovingAreSmoothAgainAtRest) {
  OffscreenTarget target(320, 200);
  Scene scene;
  scene.attach(target);
  show_map(scene, VoxelColouring::by_class);
  scene.frame();
  const auto draw = [&](bool moving) {
    scene.set_quality(moving ? DrawingQuality::moving : DrawingQuality::still);
    target.render();
    return target.read_back();
  };
  const Image at_rest = draw(false), moving = draw(true), again = draw(false);
  EXPECT_NE(at_rest, moving);
  EXPECT_EQ(at_rest, again);
}

TEST(SamePicture, TheLayersRefuseWhatDoesNotFit) {
  draw_scene(64, 64, [](Scene& scene) {
    const auto candidates = samples::candidates();
    const std::vector<double> too_few(3);
    ViewsPicture picture;
    picture.camera = PinholeCamera::from_field_of_view(64, 48, 1.0);
    picture.candidates = candidates;
    picture.scores = too_few;
    EXPECT_THROW(scene.views().show(picture), std::invalid_argument);
    picture.scores = {};
    picture.chosen = candidates.size();
    EXPECT_THROW(scene.views().show(picture), std::invalid_argument);
  });
}

}  // namespace
}  // namespace nextview
