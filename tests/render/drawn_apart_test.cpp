// Pictures of any size beside what a target shows.
#include "ui/render_target/drawn_apart.hpp"

#include <vtkRenderer.h>

#include "ui/render_target/offscreen_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {
namespace {

/// A ghost, which lets through what is behind it, and frames with letters.
void fill(Scene& scene) {
  TriangleMesh mesh;
  mesh.vertices = {{-0.3f, 0, -0.2f}, {0.3f, 0, -0.2f}, {0, 0.1f, 0.4f}, {0, -0.3f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  scene.mesh().show(mesh, MeshStyle::ghost);
  scene.region().show({Vector3::Constant(-0.5), Vector3::Constant(0.5)});
}

int alpha(const Image& image, std::size_t pixel) { return image.rgba[4 * pixel + 3]; }

TEST(DrawnApart, OverAnyPaperATransparentPictureIsThePictureOnThatPaper) {
  OffscreenTarget target(64, 48);
  Scene scene;
  scene.attach(target);
  fill(scene);
  DrawnApart apart(target, {&scene.renderer()}, {400, 300});
  scene.frame();
  const Image transparent = apart.draw(true);
  int clear = 0, between = 0;
  for (std::size_t i = 0; i < 400 * 300; ++i) {
    clear += alpha(transparent, i) == 0;
    between += alpha(transparent, i) > 0 && alpha(transparent, i) < 255;
  }
  EXPECT_GT(clear, 40'000) << "nothing is there";
  EXPECT_GT(between, 3'000) << "a ghost";
  for (const double paper : {1.0, 0.0, 0.5}) {
    scene.renderer().SetGradientBackground(false);
    scene.renderer().SetBackground(paper, paper, paper);
    const Image opaque = apart.draw(false);
    int worst = 0, far = 0;
    for (std::size_t i = 0; i < 400 * 300; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const double a = alpha(transparent, i) / 255.0;
        const double over = a * transparent.rgba[4 * i + c] + (1 - a) * 255 * paper;
        const int difference = int(std::abs(over - opaque.rgba[4 * i + c]));
        worst = std::max(worst, difference);
        far += difference > 3;
      }
    // VTK averages the samples of a pixel by their light, not by their numbers: edges are not a mixture in between.
    EXPECT_LE(worst, 32) << "on " << paper;
    EXPECT_LE(far, 3 * 400 * 300 / 20) << "on " << paper << ": more than edges";
  }
}

TEST(DrawnApart, TheTargetShowsTheSameAfterwards) {
  OffscreenTarget target(320, 240);
  Scene scene;
  scene.attach(target);
  fill(scene);
  scene.frame();
  target.render();
  const Image before = target.read_back();
  {
    DrawnApart apart(target, {&scene.renderer()}, {500, 400});
    const Image larger = apart.draw(true);
    EXPECT_EQ(larger.width, 500);
    EXPECT_EQ(larger.rgba.size(), 4u * 500 * 400);
  }
  target.render();
  EXPECT_EQ(target.read_back(), before);
}

TEST(DrawnApart, SizesAreReadAsTheyAreWritten) {
  EXPECT_EQ(picture_size("1920x1080", "SIZE"), (PictureSize{1920, 1080}));
  for (const char* text :
       {"", "x", "10x10", "1920", "1920x", "x1080", "1920x1080x", "1920X1080", "1e3x100", "9000x100"})
    EXPECT_THROW(picture_size(text, "SIZE"), std::invalid_argument) << text;
}

}  // namespace
}  // namespace nextview
