// A scan that does not fit those before it, in the window.
#include <gtest/gtest.h>

#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"

namespace nextview {
namespace {

/// A robot that says wrong where it stands, on a ring around the housing, and limits that its second scan is beyond.
Configuration inaccurate() {
  Configuration c;
  c.object.file = "slotted_housing";
  c.sensor.width = 160;
  c.sensor.height = 120;
  c.map.resolution = 0.02;
  c.views.layout = ViewLayout::rings;
  c.views.rings = 1;
  c.views.count = 12;
  c.planner.gain = "fixed-order";
  c.planner.start_elevation = 0.0;
  c.evaluation.enabled = false;
  c.robot = {0.012, 0.5};
  c.registration.mode = RegistrationConfig::Mode::check;
  c.registration.max_shift = 0.001;
  return c;
}

int orange(const Image& image, const Rectangle& r) {
  return count(image, r, [](const std::uint8_t* p) { return p[0] > 150 && p[0] > p[1] + 50 && p[1] > p[2] + 30; });
}

class WindowQuestion : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  /// Takes the second view, which is asked about, and looks until the question is drawn.
  void ask() {
    user_.run("step");
    before_ = user_.look();
    looked_along_ = user_.window().scene().camera_pose().linear().col(2);
    user_.type(key('S'));
    const auto asked = [&] { return user_.worker().progress().doubtful != nullptr; };
    while (!asked() || user_.window().seconds_to_next_frame() == 0.0) user_.window().draw(1.0 / 60);
  }

  User user_{inaccurate(), GetParam().first, GetParam().second};
  Image before_;
  Vector3 looked_along_ = Vector3::Zero();
};

TEST_P(WindowQuestion, ShowsBothCloudsInTheirColoursUntilItIsAnswered) {
  ask();
  Scene& scene = user_.window().scene().layers();
  EXPECT_TRUE(scene.fit().visible());
  EXPECT_FALSE(scene.octree().visible());
  EXPECT_TRUE(user_.window().scene().camera_pose().linear().col(2).isApprox(looked_along_, 1e-6))
      << "it is seen from the side that was looked at";
  const Rectangle place = user_.window().layout().scene;
  // Above the question, whose words cover the lower end.
  const Rectangle clouds{place.x, place.y, place.width, 0.55 * place.height};
  EXPECT_GT(count_blue(user_.look(), clouds), 200) << "the cloud so far is not to be seen";
  EXPECT_GT(orange(user_.look(), clouds), 200) << "the new scan is not to be seen";
  user_.worker().answer("Reject it");
  user_.wait();
  EXPECT_EQ(user_.session().records.size(), 1u);
  EXPECT_FALSE(scene.fit().visible());
  EXPECT_TRUE(scene.octree().visible());
  EXPECT_EQ(user_.look(), before_) << "the scene is not as it was before the question";
}

TEST_P(WindowQuestion, LayersThatAreSwitchedMeanwhileWait) {
  ask();
  Scene& scene = user_.window().scene().layers();
  user_.type(key('3'));
  do user_.window().draw(1.0 / 60);
  while (user_.window().seconds_to_next_frame() == 0.0);
  EXPECT_TRUE(scene.fit().visible());
  EXPECT_FALSE(scene.octree().visible());
  user_.worker().answer("Take it");
  user_.wait();
  EXPECT_EQ(user_.session().records.size(), 2u);
  EXPECT_FALSE(scene.octree().visible()) << "it was switched off";
  EXPECT_TRUE(scene.mesh().visible());
}

/// A script that is saved would fail at its first line.
TEST(OfferedSession, IsNoPartOfTheScriptIfItDoesNotOpen) {
  User user(inaccurate());
  user.window().offer(EarlierSession{.folder = "/nowhere", .name = "box", .views = 2});
  while (user.worker().progress().question.empty() || user.window().seconds_to_next_frame() == 0.0)
    user.window().draw(1.0 / 60);
  const std::vector<std::string> before = user.window().state().history.lines;
  user.read_question();
  user.type(Key::enter);
  user.wait();
  EXPECT_NE(user.session().message, "");
  EXPECT_EQ(user.window().state().history.lines, before);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WindowQuestion, testing::Values(std::pair{1280, 800}, std::pair{640, 480}));

}  // namespace
}  // namespace nextview
