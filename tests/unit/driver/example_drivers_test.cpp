// The drivers of assets/drivers, as they come.
#include <numbers>

#include "core/cloud/point_cloud.hpp"
#include "tests/unit/driver/fake_scanner.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

class ExampleDriver : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v python3 >/dev/null") != 0) GTEST_SKIP() << "there is no python3";
  }

  DriverOptions run(const std::string& script, const std::string& more = {}) {
    std::filesystem::create_directories(scans);
    return {.command = "python3 '" NEXTVIEW_DRIVERS "/" + script + "' '" + scans.string() + "' " + more,
            .timeout = 10.0,
            .folder = folder / "captures"};
  }

  TemporaryFolder folder;
  std::filesystem::path scans = folder / "my scans";
};

std::string text_of(const Pose& pose) {
  std::string text;
  for (const double value : by_rows(pose)) text += fmt::format("{} ", value);
  return text;
}

const std::vector<Vector3>& points_of(const Result<Capture>& capture) {
  return std::get<std::vector<Vector3>>(std::get<Capture>(capture).measured);
}

TEST_F(ExampleDriver, HandHeldWaitsForAScanAndTakesItsPose) {
  const auto connection = std::make_shared<DriverConnection>(run("hand_held.py"));
  EXPECT_TRUE(connection->is_free_hand());
  EXPECT_EQ(connection->greeting().timeout, 0.0);
  DriverRobot robot(connection, at(0, 0, 1));
  const auto reach = robot.reach(robot.pose(), std::vector<View>{{at(0, 0, 3)}, {Pose::Identity()}});
  EXPECT_EQ(reach[0].cost.distance, 2.0);
  EXPECT_NEAR(reach[1].cost.rotation, 0.3, 1e-9);
  ASSERT_TRUE(std::holds_alternative<Pose>(robot.move_to({at(0.1, 0.2, 0.3)}, {})));
  DriverSource source(connection, 1);
  const auto after = [&](const std::string& name, double seconds, bool with_pose) {
    return std::jthread([=, this] {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
      if (with_pose) std::ofstream(scans / (name + ".txt")) << text_of(at(9, 8, 7));
      write_ply({{1, 2, 3}}, scans / (name + ".ply"));
    });
  };
  {
    const auto person = after("one", 0.3, true);
    const Result<Capture> capture = source.capture({}, 1, {});
    ASSERT_TRUE(std::holds_alternative<Capture>(capture)) << failure_of(capture).reason;
    EXPECT_EQ(points_of(capture).at(0), Vector3(1, 2, 3));
    EXPECT_EQ(std::get<Capture>(capture).T_world_camera.matrix(), at(9, 8, 7).matrix());
    EXPECT_EQ(robot.pose().matrix(), at(9, 8, 7).matrix());
  }
  const auto person = after("another", 0.0, false);
  const Result<Capture> capture = source.capture({}, 2, {});
  ASSERT_TRUE(std::holds_alternative<Capture>(capture)) << failure_of(capture).reason;
  EXPECT_EQ(std::get<Capture>(capture).T_world_camera.matrix(), at(0.1, 0.2, 0.3).matrix()) << "where it was wanted";
}

TEST_F(ExampleDriver, HandHeldNeedNotBeWaitedFor) {
  const auto connection = std::make_shared<DriverConnection>(run("hand_held.py"));
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    stop.request_stop();
  });
  const Failure failure = failure_of(connection->capture(1, 1, stop.get_token()));
  EXPECT_EQ(failure.kind, Failure::cancelled) << failure.reason;
  EXPECT_FALSE(connection->is_lost());
}

TEST_F(ExampleDriver, TurntableReachesItsCircle) {
  const auto connection = std::make_shared<DriverConnection>(run("turntable.py", "0.6 0.3"));
  ASSERT_TRUE(connection->greeting().start);
  const auto seen_at = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return look_at({0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.3}, Vector3::Zero());
  };
  EXPECT_TRUE(connection->greeting().start->isApprox(seen_at(0), 1e-12)) << connection->greeting().start->matrix();
  DriverRobot robot(connection, Pose::Identity());
  DriverSource source(connection, 1);
  EXPECT_EQ(connection->greeting().views.size(), 24u) << "every 15 degrees";
  const auto reach = robot.reach(robot.pose(), std::vector<View>{{seen_at(90)}, {at(0, 0, 3)}, {seen_at(-30)}});
  EXPECT_NEAR(reach[0].cost.rotation, std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(reach[2].cost.distance, 0.6 * std::numbers::pi / 6, 1e-9);
  EXPECT_THAT(reach[1].unreachable, HasSubstr("off the circle around the turntable"));
  EXPECT_EQ(failure_of(robot.move_to({at(0, 0, 3)}, {})).kind, Failure::unreachable);
  ASSERT_TRUE(std::holds_alternative<Pose>(robot.move_to({seen_at(90)}, {})));
  EXPECT_THAT(failure_of(source.capture({seen_at(90)}, 1, {})).reason, HasSubstr("there is no scan of 90 degrees"));
  write_ply({{1, 2, 3}}, scans / "088.ply");
  const Result<Capture> capture = source.capture({seen_at(90)}, 1, {});
  ASSERT_TRUE(std::holds_alternative<Capture>(capture)) << failure_of(capture).reason;
  EXPECT_TRUE(std::get<Capture>(capture).T_world_camera.isApprox(seen_at(88), 1e-12));
  const DriverConnection again(run("turntable.py", "0.6 0.3"));
  ASSERT_EQ(again.greeting().views.size(), 1u) << "where there are scans";
  EXPECT_TRUE(again.greeting().views[0].isApprox(seen_at(88), 1e-12));
  EXPECT_TRUE(again.greeting().start->isApprox(seen_at(88), 1e-12));
}

TEST_F(ExampleDriver, WithoutAFolderSaysWhatItNeeds) {
  DriverOptions options = run("turntable.py");
  options.command = "python3 '" NEXTVIEW_DRIVERS "/turntable.py'";
  try {
    DriverConnection connection(options);
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("exit code 1; it last said:"));
  }
}

}  // namespace
}  // namespace nextview
