// What lies flat over a scene: legends and the paper behind them, of any size of display; its caption.
#include "ui/scene/scene_overlay.hpp"

#include <gtest/gtest.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include "ui/render_target/offscreen_target.hpp"
#include "ui/scene/scene.hpp"
#include "ui/scene/scene_renderer.hpp"

namespace nextview {
namespace {

constexpr int design_width = 500, design_height = 320;  // [px of the design]

/// An overlay over plain white, without axes and scale bar.
Image drawn(double scale, const std::function<void(SceneOverlay&)>& fill,
            const Eigen::Vector2i& size = {design_width, design_height}) {
  OffscreenTarget target(int(size.x() * scale), int(size.y() * scale));
  vtkNew<SceneRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  vtkNew<vtkContextActor> actor;
  vtkNew<SceneOverlay> overlay;
  overlay->renderer = renderer;
  overlay->axes = overlay->scale_bar = false;
  overlay->scale = scale;
  fill(*overlay);
  actor->GetScene()->AddItem(overlay);
  actor->GetScene()->SetRenderer(renderer);
  renderer->AddActor(actor);
  target.window().AddRenderer(renderer);
  target.render();
  Image image = target.read_back();
  actor->GetScene()->SetRenderer(nullptr);
  target.window().RemoveRenderer(renderer);
  return image;
}

using Box = Eigen::AlignedBox2d;

/// What encloses the pixels that are of a kind [px of the design, from the upper left].
Box box_of(const Image& image, double scale, const std::function<bool(const std::uint8_t*)>& is_wanted) {
  Box box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_wanted(&image.rgba[(std::size_t(y) * image.width + x) * 4])) {
        box.extend(Eigen::Vector2d(x, y) / scale);
        box.extend(Eigen::Vector2d(x + 1, y + 1) / scale);
      }
  return box;
}

bool is_red(const std::uint8_t* p) { return p[0] > 200 && p[1] < 60 && p[2] < 60; }
bool is_dark(const std::uint8_t* p) { return p[0] < 200 && p[1] < 200 && p[2] < 200; }
bool is_not_white(const std::uint8_t* p) { return p[0] < 252; }

void add_legends(SceneOverlay& overlay) {
  for (const char* name : {"one", "another, whose name is wider than the bar"})
    overlay.legends.push_back({"title", {{name, {1, 0, 0}}}, Legend::Range{ColourMap::score(), 0, 1, "m"}});
}

TEST(SceneOverlay, LegendsAreInTheSamePlaceOnAnyDisplay) {
  const auto boxes = [](double scale) {
    const Image image = drawn(scale, add_legends);
    return std::pair(box_of(image, scale, is_red), box_of(image, scale, is_dark));
  };
  const auto usual = boxes(1.0);
  ASSERT_FALSE(usual.first.isEmpty());
  EXPECT_GT(usual.first.min().x(), design_width / 3.0) << "at the right";
  EXPECT_NEAR(usual.second.min().y(), 20, 8) << "and above";
  EXPECT_GT(usual.second.max().x(), design_width / 2.0);
  for (const double scale : {1.5, 2.0, 3.0}) {
    const auto fine = boxes(scale);
    for (const auto& [a, b] : {std::pair(usual.first, fine.first), std::pair(usual.second, fine.second)}) {
      ASSERT_FALSE(b.isEmpty()) << scale;
      // Letters have whole pixels, so what they push away may be a little elsewhere.
      EXPECT_LT((a.min() - b.min()).cwiseAbs().maxCoeff(), 12) << scale;
      EXPECT_LT((a.max() - b.max()).cwiseAbs().maxCoeff(), 12) << scale;
    }
  }
}

TEST(SceneOverlay, PaperLiesBehindAllOfTheLegendsAndNothingElse) {
  for (const double scale : {1.0, 2.0}) {
    const Box legends = box_of(drawn(scale, add_legends), scale, is_not_white);
    const Box paper = box_of(drawn(scale,
                                   [](SceneOverlay& overlay) {
                                     add_legends(overlay);
                                     overlay.backed = true;
                                   }),
                             scale, is_not_white);
    EXPECT_TRUE(paper.contains(legends));
    EXPECT_GT(legends.min().x() - paper.min().x(), 4) << "a little more to the left";
    EXPECT_GT(paper.max().x() - legends.max().x(), 4) << "to the right";
    EXPECT_LT(paper.sizes().x(), legends.sizes().x() + 40);
    EXPECT_LT(paper.sizes().y(), legends.sizes().y() + 40);
    EXPECT_TRUE(
        box_of(drawn(scale, [](SceneOverlay& overlay) { overlay.backed = true; }), scale, is_not_white).isEmpty())
        << "without legends there is none";
  }
}

TEST(SceneOverlay, ACaptionStandsAtTheUpperLeft) {
  EXPECT_TRUE(box_of(drawn(1.0, [](SceneOverlay&) {}), 1.0, is_not_white).isEmpty());
  for (const double scale : {1.0, 2.0}) {
    const Box words = box_of(drawn(scale, [](SceneOverlay& overlay) { overlay.caption = "Height"; }), scale, is_dark);
    ASSERT_FALSE(words.isEmpty());
    EXPECT_NEAR(words.min().x(), 17, 3);
    EXPECT_TRUE(words.min().y() > 8 && words.max().y() < 45) << words.min().y() << " to " << words.max().y();
    EXPECT_TRUE(words.max().x() > 40 && words.max().x() < 120) << words.max().x();
  }
}

/// As of two scenes beside each other.
TEST(SceneOverlay, InANarrowPictureLabelsLieAboveTheScaleBar) {
  constexpr int narrow = 335, axes_and_bar = 92;
  const Image image =
      drawn(1.0,
            [](SceneOverlay& overlay) {
              overlay.axes = overlay.scale_bar = true;
              overlay.labels.push_back({{Vector3(0.2, -0.25, 0)}, "a label of some length", {1, 0, 0}, true});
            },
            {narrow, design_height});
  const Box label = box_of(image, 1.0, is_red);
  ASSERT_FALSE(label.isEmpty());
  EXPECT_GT(label.sizes().x(), 100);
  EXPECT_LT(label.max().y(), design_height - axes_and_bar);
  EXPECT_GT(label.max().y(), design_height - axes_and_bar - 30) << "and no farther";
}

/// Where axes and scale bar are in its way it goes above them, not to the legend at the other side.
TEST(SceneOverlay, ALabelStaysNearItsPlace) {
  const auto drawn_at = [](bool axes_and_bar) {
    const Image image = drawn(1.0,
                              [&](SceneOverlay& overlay) {
                                overlay.axes = overlay.scale_bar = axes_and_bar;
                                overlay.legends.push_back({"legend", {{"one", theme::free}}, {}});
                                overlay.labels.push_back({{Vector3(-0.4, -0.24, 0)}, "candidate 10", {1, 0, 0}, true});
                              },
                              {900, 500});
    return box_of(image, 1.0, is_red);
  };
  const Box free = drawn_at(false), moved = drawn_at(true);
  ASSERT_FALSE(free.isEmpty() || moved.isEmpty());
  EXPECT_NE(free.min().y(), moved.min().y()) << "it was not in the way";
  EXPECT_LT((free.center() - moved.center()).norm(), 120);
}

/// As of two scenes beside each other, whose captions name them.
TEST(SceneOverlay, LabelsKeepClearOfTheCaption) {
  const auto add = [](SceneOverlay& overlay) {
    overlay.caption = "branch 2, 3 views";
    overlay.labels.push_back({{Vector3(-0.37, 0.193, 0)}, "candidate 46", {1, 0, 0}, true});
  };
  const Image image = drawn(1.0, add);
  const Box label = box_of(image, 1.0, is_red);
  ASSERT_FALSE(label.isEmpty());
  const Box caption = box_of(drawn(1.0, [](SceneOverlay& o) { o.caption = "branch 2, 3 views"; }), 1.0, is_dark);
  EXPECT_TRUE(label.intersection(caption).isEmpty());
}

/// Perpendicular to the view, one metre away: its picture is as high as the angle says.
TEST(SceneOverlay, TheScaleBarIsAsLongAsItSays) {
  constexpr double angle = 30.0;  // [deg], VTK's usual one
  for (const double scale : {1.0, 2.0}) {
    const Image image = drawn(scale, [](SceneOverlay& overlay) { overlay.scale_bar = true; });
    const Box bar = box_of(image, scale, is_dark);
    ASSERT_FALSE(bar.isEmpty());
    const double pixels_per_metre = design_height / (2 * std::tan(angle / 2 * M_PI / 180));
    // 1, 2 or 5 times a power of ten that is at most 150 px: 0.2 m of these. Its ends are 2 px wide.
    EXPECT_NEAR(bar.sizes().x(), 0.2 * pixels_per_metre, 3) << scale;
  }
}

/// The right 188 pixels of a picture with legends, and with a label that belongs where they are.
std::vector<std::uint8_t> beside_legends(const std::vector<Label>& labels) {
  const auto fill = [&](SceneOverlay& overlay) {
    for (int i = 0; i < 6; ++i)
      overlay.legends.push_back({"legend", {{"one", theme::free}}, Legend::Range{ColourMap::score(), 0, 1, "m"}});
    overlay.labels = labels;
  };
  const Image image = drawn(1.0, fill, {675, 490});
  std::vector<std::uint8_t> strip;
  for (int y = 0; y < 490; ++y)
    for (int x = 675 - 188; x < 675; ++x) strip.push_back(image.rgba[(std::size_t(y) * 675 + x) * 4]);
  return strip;
}

TEST(SceneOverlay, LabelsKeepClearOfLegends) {
  const auto clear = beside_legends({});
  for (const double across : {0.1, 0.2, 0.3}) {  // from the middle towards the legends; the camera is 1 m away
    const Label label{{Vector3(across, 0.05, 0)}, "region of interest, 1.28 m", theme::chosen};
    EXPECT_EQ(beside_legends({label}), clear) << across;
  }
  const Label within{{Vector3(0.3, 0.05, 0)},
                     "a label that is far too long to stand beside the legends anywhere in "
                     "the picture, whatever is done about it",
                     theme::chosen};
  EXPECT_NE(beside_legends({within}), clear) << "this test sees a label over the legends";
}

// As the numbers of views: most cameras stand beside a picture of the object.
TEST(SceneOverlay, OnlyStrongLabelsOfWhatLiesBesideThePictureStandAtItsBorder) {
  const auto is_drawn = [](const Vector3& place, bool strong) {
    const auto add = [&](SceneOverlay& overlay) { overlay.labels.push_back({{place}, "12", {1, 0, 0}, strong}); };
    return !box_of(drawn(1.0, add), 1.0, is_red).isEmpty();
  };
  EXPECT_TRUE(is_drawn({0.1, 0.1, 0}, false));
  EXPECT_FALSE(is_drawn({3.0, 0.1, 0}, false));
  EXPECT_TRUE(is_drawn({3.0, 0.1, 0}, true));
}

/// A square, and a number at so much behind it [m], as it is drawn from before the square.
bool number_is_seen(double behind, DrawingQuality quality, bool orthographic, MeshStyle style) {
  TriangleMesh square;
  square.vertices = {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto drawn_with = [&](bool number) {
    OffscreenTarget target(design_width, design_height);
    Scene scene;
    scene.attach(target);
    scene.mesh().show(square, style);
    const std::array path{look_at(Vector3(0.1, behind, 0.2), Vector3::Zero())};
    ViewsPicture views;
    views.path = path;
    views.numbered_path = number;
    scene.views().show(views);
    const std::array corners{Vector3(-1, 0, -1), Vector3(1, 0, 1)};
    scene.frame(corners, {.azimuth = -80, .elevation = 10});
    scene.set_orthographic(orthographic, Vector3::Zero());
    scene.set_quality(quality);
    target.render();
    return target.read_back().rgba;
  };
  return drawn_with(true) != drawn_with(false);
}

// An operator took the number of a view behind the object for one before it.
TEST(SceneOverlay, NumbersOfViewsBehindTheObjectAreHidden) {
  for (const DrawingQuality quality : {DrawingQuality::still, DrawingQuality::quick, DrawingQuality::coarse})
    for (const bool orthographic : {false, true}) {
      EXPECT_TRUE(number_is_seen(-0.3, quality, orthographic, MeshStyle::solid)) << int(quality) << orthographic;
      EXPECT_TRUE(number_is_seen(0.05, quality, orthographic, MeshStyle::solid)) << "nearly in the square";
      EXPECT_FALSE(number_is_seen(0.5, quality, orthographic, MeshStyle::solid)) << int(quality) << orthographic;
      EXPECT_TRUE(number_is_seen(0.5, quality, orthographic, MeshStyle::ghost)) << "through a ghost it is seen";
    }
}

}  // namespace
}  // namespace nextview
