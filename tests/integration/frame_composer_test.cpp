#include <backends/imgui_impl_opengl3.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "ui/render_target/gl_constants.hpp"

namespace nextview {
namespace {

constexpr double frame = 1.0 / 60;  // [s]

/// What the last frame shows, all of it drawn at once: the scene's picture, then every panel. In a framebuffer of its
/// own, whose rows are in the other order than the back buffer's: a renderer may round otherwise there.
Image drawn_whole(RenderTarget& target) {
  target.make_current();
  vtkGenericOpenGLRenderWindow& window = target.window();
  vtkOpenGLState& state = *window.GetState();
  vtkNew<vtkOpenGLFramebufferObject> whole;
  whole->SetContext(&window);
  whole->PopulateFramebuffer(target.width(), target.height(), true, 1, VTK_UNSIGNED_CHAR, false, 0, 0);
  whole->Bind(gl_draw_framebuffer);
  window.BlitDisplayFramebuffer();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  whole->Bind(gl_read_framebuffer);
  state.vtkglBindFramebuffer(gl_draw_framebuffer, 0);
  state.vtkglDrawBuffer(gl_back);
  state.vtkglBlitFramebuffer(0, 0, target.width(), target.height(), 0, 0, target.width(), target.height(),
                             gl_color_buffer_bit, gl_nearest);
  state.vtkglBindFramebuffer(gl_read_framebuffer, 0);
  whole->ReleaseGraphicsResources(&window);
  return target.read_back();
}

/// Looks at frames one by one and compares each with one that is drawn whole.
class Comparison : public ::testing::Test {
 protected:
  void look(const char* what, int frames = 1) {
    for (int i = 0; i < frames && !HasFailure(); ++i) {
      const bool differs = user_.window().draw(frame);
      drawn_partly_ += differs && user_.window().pixels_drawn() < pixels() / 2;
      const Image seen = user_.look();
      ASSERT_TRUE(seen == drawn_whole(user_.target())) << what << ", frame " << i;
    }
  }
  /// While the session's worker is busy, and until nothing new comes.
  void look_until_done(const char* what) {
    do look(what);
    while (!HasFailure() && !user_.window().is_still());
  }
  void hover(double x, double y) {
    user_.move(x, y);
    look("hovering");
  }
  std::size_t pixels() { return std::size_t(user_.target().width()) * std::size_t(user_.target().height()); }

  User user_{small_scan(), half_width, half_height, half_scale};
  const Layout layout_ = user_.window().layout();
  int drawn_partly_ = 0;
};

TEST_F(Comparison, StepsAndPanels) {
  user_.type(key('S'));
  look_until_done("a step");
  for (const char* script : {"panel view\n", "panel layers\n", "select-view 3\n", "select-view 4\n",
                             "panel inspector\n", "panel log\n", "panel candidates\n", "panel curves\n", "palette\n"}) {
    user_.window().run_script(parse_script(script));
    look_until_done(script);
  }
  user_.write("vi");
  look_until_done("a text in the palette");
  user_.type(Key::escape);
  look_until_done("the palette is closed");
  EXPECT_GT(drawn_partly_, 10);
}

TEST_F(Comparison, PointerOverEverything) {
  user_.type(key('S'));
  user_.wait();
  for (int i = 0; i <= 40; ++i) hover((half_width - 1) * i / 40.0, 6 + 390 * (i * 7 % 41) / 40.0);
  for (const Rectangle& r : {layout_.left, layout_.right, layout_.bottom, layout_.scene}) {
    hover(r.x + r.width / 2, r.y + r.height / 2);
    for (const double steps : {-1, -1, 1, 1}) {
      user_.window().push(input::Wheel{steps});
      look("scrolling", 2);
    }
    look("after scrolling", 8);
  }
  hover(50 * half_scale, layout_.control_bar.y + 25 * half_scale);
  look("a tooltip", 36);  // it comes after 27
  for (double x = 11; x < 300; x += 40) {
    user_.click(x * half_scale, 12 * half_scale);
    look("a menu", 5);
    hover((x + 20) * half_scale, 60 * half_scale);
    hover((x + 20) * half_scale, 91 * half_scale);
    user_.type(Key::escape);
    look("a menu is closed", 3);
  }
  EXPECT_GT(drawn_partly_, 40);
}

TEST_F(Comparison, TurningAndResizing) {
  user_.run("step\nselect-view 3\n");
  const Rectangle& scene = layout_.scene;
  hover(scene.x + 40, scene.y + 100);
  user_.press();
  for (int i = 0; i < 12; ++i) {
    user_.move(scene.x + 40 + 9 * i, scene.y + 100 + 4 * i);
    look("turning");
  }
  user_.release();
  look("the camera comes to rest", 20);
  EXPECT_GT(drawn_partly_, 10);
  for (const auto& [w, h] : {std::pair{600, 360}, {620, 380}, {half_width, half_height}}) {
    user_.target().window().SetSize(w, h);
    look("another size", 4);
  }
}

TEST_F(Comparison, DrawsOnlyWhatIsNew) {
  user_.type(key('S'));
  user_.wait();
  EXPECT_FALSE(user_.window().draw(frame)) << "nothing happened";
  const Rectangle& panel = layout_.right;
  hover(panel.x + 100 * half_scale, panel.y + 190 * half_scale);
  user_.move(panel.x + 100 * half_scale, panel.y + (190 + 42) * half_scale);
  EXPECT_TRUE(user_.window().draw(frame));
  EXPECT_LT(user_.window().pixels_drawn(), pixels() / 2) << "another row is lit";
  user_.wait();
  user_.window().push(input::Expose{});
  EXPECT_TRUE(user_.window().draw(frame)) << "the display lost its picture";
  EXPECT_EQ(user_.window().pixels_drawn(), pixels());
}

TEST_F(Comparison, EdgesAreSmoothAgainWhenTheCameraIsAtRest) {
  const Rectangle& scene = layout_.scene;
  user_.move(scene.x + 60, scene.y + 100);
  user_.press();
  user_.move(scene.x + 100, scene.y + 100);
  do user_.window().draw(1e-3);
  while (user_.window().seconds_to_next_frame() == 0.0);
  const Image in_motion = user_.look();
  EXPECT_GT(user_.window().seconds_to_next_frame(), 0.0);
  EXPECT_LE(user_.window().seconds_to_next_frame(), 0.15) << "the still picture is late";
  user_.window().draw(0.1);
  user_.window().draw(0.1);
  user_.wait();
  const Image at_rest = user_.look();
  EXPECT_FALSE(at_rest == in_motion);
  EXPECT_GT(user_.window().seconds_to_next_frame(), 0.15) << "it is drawn once";
  user_.run("toggle-region\ntoggle-region\n");
  EXPECT_TRUE(user_.look() == at_rest);
  user_.run("zoom 1\n");
  const Image zoomed = user_.look();
  user_.window().draw(0.2);
  EXPECT_TRUE(user_.look() == zoomed) << "a script's camera does not follow the pointer";
}

}  // namespace
}  // namespace nextview
