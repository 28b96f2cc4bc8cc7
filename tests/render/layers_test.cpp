#include "tests/render/render_test.hpp"
#include "tests/render/samples.hpp"

namespace nextview {
namespace {

ViewsPicture views(const std::vector<Pose>& candidates, const std::vector<double>& scores) {
  ViewsPicture picture;
  picture.camera = PinholeCamera::from_field_of_view(640, 480, 1.0123);
  picture.candidates = candidates;
  picture.scores = scores;
  picture.score_name = "occlusion aware";
  picture.score_unit = "nats";
  return picture;
}

RENDER_TEST(mesh_solid, 960, 600, {
  scene.mesh().show(samples::torus());
  scene.frame();
})

RENDER_TEST(mesh_wire, 960, 600, {
  scene.mesh().show(samples::torus(), MeshStyle::wire);
  scene.frame();
})

RENDER_TEST(mesh_ghost, 960, 600, {
  scene.mesh().show(samples::torus(), MeshStyle::ghost);
  scene.frame();
})

RENDER_TEST(cloud, 960, 600, {
  scene.cloud().show(samples::cloud(samples::usual_viewer));
  scene.frame();
})

RENDER_TEST(octree_by_class, 960, 600, {
  const auto map = samples::map(samples::usual_viewer);
  scene.octree().show(map.grid, map.voxels);
  scene.frame();
})

RENDER_TEST(octree_by_probability, 960, 600, {
  const auto map = samples::map(samples::usual_viewer);
  scene.octree().show(map.grid, map.voxels, {}, VoxelColouring::by_probability);
  scene.frame();
})

RENDER_TEST(octree_with_free_space, 960, 600, {
  const auto map = samples::map(samples::usual_viewer);
  scene.octree().show(map.grid, map.voxels, {true, true, true});
  scene.frame();
})

RENDER_TEST(views_scored, 960, 600, {
  const auto candidates = samples::candidates();
  const auto scores = samples::scores(candidates, samples::usual_viewer);
  const std::vector<std::size_t> taken{36, 22};
  const std::vector<Pose> path{look_at(samples::usual_viewer, Vector3::Zero()), candidates[36], candidates[22]};
  auto picture = views(candidates, scores);
  picture.taken = taken;
  picture.path = path;
  picture.chosen = 9;
  scene.mesh().show(samples::torus());
  scene.views().show(picture);
  scene.frame();
})

RENDER_TEST(rays, 960, 600, {
  const auto pose = look_at(Vector3(0.45, -0.7, 0.35), Vector3::Zero());
  scene.mesh().show(samples::torus(), MeshStyle::ghost);
  scene.rays().show(samples::rays(pose), {"entropy along rays", "nats"});
  scene.frame();
})

RENDER_TEST(region, 960, 600, {
  scene.mesh().show(samples::torus());
  scene.region().show({Vector3::Constant(-0.32), Vector3::Constant(0.32)});
  scene.frame();
})

}  // namespace
}  // namespace nextview
