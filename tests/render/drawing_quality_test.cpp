// What a scene leaves out while somebody waits for its picture, where a processor draws.
#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include "ui/render_target/offscreen_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {
namespace {

/// Every other voxel of a cube, as on a chess board: six faces each.
void show_chess_board(Scene& scene, int edge) {
  const VoxelGrid grid{1.0 / edge, {-edge / 2, -edge / 2, -edge / 2}, {edge, edge, edge}};
  std::vector<Voxel> voxels(grid.voxel_count());
  for (std::uint32_t i = 0; i < voxels.size(); ++i)
    if (grid.cell(i).sum() % 2 == 0) voxels[i] = {0.9f, 0.3f, VoxelClass::occupied, true, 0};
  scene.octree().show(grid, voxels);
  scene.frame();
}

/// Voxels are fewer while the camera moves; a map of very many voxels has fewer whenever there is no time.
TEST(DrawingQualities, VoxelsAreFewerOnlyWhereThatIsWorthIt) {
  using enum DrawingQuality;
  for (const auto& [edge, is_large] : {std::pair{26, false}, {38, true}}) {
    OffscreenTarget target(160, 120);
    Scene scene;
    scene.attach(target);
    show_chess_board(scene, edge);
    ASSERT_EQ(scene.octree().face_count(), std::size_t(3 * edge * edge * edge));
    ASSERT_TRUE(scene.octree().face_count() > 40'000 && (scene.octree().face_count() > 120'000) == is_large);
    const auto picture = [&] {
      target.render();
      return target.read_back();
    };
    for (const DrawingQuality quality : {moving, still, coarse, quick, still}) {
      scene.set_quality(quality);
      const Image drawn = picture();
      const bool fewer = target.draws_in_software() && (quality == moving || (is_large && quality != still));
      scene.octree().set_coarse(fewer);
      EXPECT_TRUE(drawn == picture()) << int(quality) << " of " << edge;
      scene.octree().set_coarse(!fewer);
      EXPECT_FALSE(drawn == picture()) << "this test sees which voxels are drawn";
    }
  }
}

TEST(DrawingQualities, EdgesAreSmoothAtRestAlone) {
  OffscreenTarget target(64, 48);
  Scene scene;
  scene.set_quality(DrawingQuality::moving);  // there is nothing to draw into yet
  scene.attach(target);
  scene.frame();
  for (const DrawingQuality quality : {DrawingQuality::moving, DrawingQuality::quick, DrawingQuality::coarse}) {
    scene.set_quality(quality);
    EXPECT_EQ(target.window().GetMultiSamples(), 0) << int(quality);
    scene.set_quality(DrawingQuality::still);
    EXPECT_EQ(target.window().GetMultiSamples(), RenderTarget::smooth_samples);
  }
}

TEST(SceneCamera, HasItsAngleFromTheBeginning) {
  Scene scene;
  EXPECT_EQ(scene.renderer().GetActiveCamera()->GetViewAngle(), Scene::vertical_angle) << "before it is framed";
}

}  // namespace
}  // namespace nextview
