#include "core/driver/driver_scanner.hpp"

#include <fstream>

#include "tests/unit/driver/fake_scanner.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(DriverScanner, DescribesItselfAsItSaid) {
  const FakeScanner fake("stop");
  const auto connection = fake.connect();
  DriverSource source(connection, 1);
  EXPECT_EQ(connection->greeting().name, "fake");
  EXPECT_TRUE(connection->greeting().can("stop"));
  EXPECT_FALSE(connection->greeting().can("fly"));
  EXPECT_EQ(source.describe().camera.width, 4);
  EXPECT_EQ(source.describe().camera.height, 3);
  EXPECT_EQ(source.describe().camera.fx, 4.0);
  EXPECT_EQ(source.describe().camera.cy, 1.0);
  EXPECT_EQ(source.describe().max_range, 2.0);
  EXPECT_EQ(source.describe().range_noise, 0.001);
  EXPECT_FALSE(source.describe().start);
}

TEST(DriverScanner, MovesAndCaptures) {
  const FakeScanner fake;
  const auto connection = fake.connect();
  DriverRobot robot(connection, at(0, 0, 1));
  DriverSource source(connection, 1);
  EXPECT_EQ(robot.pose().matrix(), at(0, 0, 1).matrix());
  const Pose wanted = at(0.1, -1.0 / 3.0, 1e-17);
  const Result<Pose> reached = robot.move_to({wanted}, {});
  ASSERT_TRUE(std::holds_alternative<Pose>(reached)) << failure_of(reached).reason;
  EXPECT_EQ(std::get<Pose>(reached).matrix(), wanted.matrix()) << "to the bit, through JSON";
  EXPECT_EQ(robot.pose().matrix(), wanted.matrix());
  const Result<Capture> capture = source.capture({wanted}, 1, {});
  ASSERT_TRUE(std::holds_alternative<Capture>(capture)) << failure_of(capture).reason;
  EXPECT_EQ(std::get<Capture>(capture).T_world_camera.matrix(), wanted.matrix());
  EXPECT_EQ(std::get<DepthImage>(std::get<Capture>(capture).measured).range, std::vector<float>(12, 1.0f));
  EXPECT_EQ(std::get<Capture>(capture).max_range, 2.0);
}

TEST(DriverScanner, ThePoseOfTheCaptureCounts) {
  FakeScanner fake;
  fake.options.reached_within = 10.0;
  const auto connection = fake.connect();
  DriverRobot robot(connection, Pose::Identity());
  fake.misbehave("far", "capture");
  const Result<Capture> capture = DriverSource(connection, 1).capture({}, 1, {});
  ASSERT_TRUE(std::holds_alternative<Capture>(capture));
  EXPECT_EQ(std::get<Capture>(capture).T_world_camera.translation(), Vector3(7, 0, 0));
  EXPECT_EQ(robot.pose().translation(), Vector3(7, 0, 0));
}

TEST(DriverScanner, AViewThatWasMissedIsNotReached) {
  const FakeScanner fake;
  DriverRobot robot(fake.connect(), Pose::Identity());
  fake.misbehave("far", "move");
  const Failure failure = failure_of(robot.move_to({at(1, 0, 0)}, {}));
  EXPECT_EQ(failure.kind, Failure::unreachable);
  EXPECT_THAT(failure.reason, AllOf(HasSubstr("6 m and 17.2 degrees"), HasSubstr("0.05 m and 5 degrees")));
  EXPECT_EQ(robot.pose().translation(), Vector3(7, 0, 0)) << "there it is all the same";
}

TEST(DriverScanner, ACaptureFarFromTheViewIsNone) {
  for (const bool by_hand : {false, true}) {
    const FakeScanner fake(by_hand ? "free-hand" : "");
    const auto connection = fake.connect();
    fake.misbehave("far", "capture");
    const Result<Capture> capture = DriverSource(connection, 1).capture({Pose::Identity()}, 1, {});
    EXPECT_EQ(std::holds_alternative<Capture>(capture), by_hand);
    if (by_hand) continue;
    EXPECT_EQ(failure_of(capture).kind, Failure::no_data);
    EXPECT_THAT(failure_of(capture).reason, HasSubstr("the scan was taken 7 m and 0 degrees from the view"));
  }
}

TEST(DriverScanner, IsWhereItsFirstCaptureSaid) {
  FakeScanner fake;
  const auto connection = fake.connect();
  EXPECT_FALSE(connection->knows_pose());
  fake.misbehave("far", "capture");
  connection->capture(1, 1, {});  // to find the object, before there is a robot
  EXPECT_EQ(DriverRobot(connection, at(0, 0, 1)).pose().translation(), Vector3(7, 0, 0));
}

TEST(DriverScanner, ASimulatorKnowsTheObject) {
  const FakeScanner fake("simulated"), other;
  EXPECT_TRUE(fake.connect()->is_simulated());
  EXPECT_FALSE(other.connect()->is_simulated());
  other.misbehave("object", "hello");
  EXPECT_TRUE(other.connect()->is_simulated());
}

TEST(DriverScanner, LeavesNoCapturesBehind) {
  const FakeScanner fake;
  for (const char* fault : {"", "wrong_size", "not_rigid"}) {
    fake.misbehave(fault, "capture");
    fake.connect()->capture(1, 1, {});
    EXPECT_FALSE(std::filesystem::exists(fake.options.folder)) << fault;
  }
  std::filesystem::create_directory(fake.options.folder);
  const auto theirs = fake.options.folder / "theirs";
  std::ofstream(theirs) << "kept";
  fake.misbehave("wrong_size", "capture");
  fake.connect()->capture(1, 1, {});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(fake.options.folder), {}), 1);
  EXPECT_TRUE(std::filesystem::exists(theirs));
}

TEST(DriverScanner, AHandReachesWhatItReaches) {
  const FakeScanner fake("free-hand");
  DriverRobot robot(fake.connect(), Pose::Identity());
  fake.misbehave("far", "move");
  const Result<Pose> reached = robot.move_to({at(1, 0, 0)}, {});
  ASSERT_TRUE(std::holds_alternative<Pose>(reached)) << failure_of(reached).reason;
  EXPECT_EQ(std::get<Pose>(reached).translation(), Vector3(7, 0, 0));
}

TEST(DriverScanner, StaysWithinItsWorkingVolume) {
  FakeScanner fake;
  fake.options.working_volume = Eigen::AlignedBox3d(Vector3(-1, -1, 0), Vector3(1, 1, 2));
  bool asked = false;
  fake.options.confirm = [&](const Pose&, const Pose&) { return asked = true; };
  DriverRobot robot(fake.connect(), at(0, 0, 1));
  const Failure failure = failure_of(robot.move_to({at(0, 0, -0.1)}, {}));
  EXPECT_EQ(failure.kind, Failure::unreachable);
  EXPECT_THAT(failure.reason, AllOf(HasSubstr("(0, 0, -0.1) m"), HasSubstr("robot.working_volume")));
  EXPECT_FALSE(asked);
  Pose nowhere = at(0, 0, 1);
  nowhere.translation().x() = std::nan("");
  const auto reach = robot.reach(robot.pose(), std::vector<View>{{at(0, 0, 3)}, {at(0, 0, 1)}, {nowhere}});
  ASSERT_EQ(reach.size(), 3u);
  EXPECT_THAT(reach[0].unreachable, HasSubstr("working volume"));
  EXPECT_EQ(reach[1].unreachable, "");
  EXPECT_EQ(reach[1].cost.seconds, 2.0);
  EXPECT_NE(reach[2].unreachable, "");
  fake.misbehave("die", "reach");
  EXPECT_THAT(robot.reach(robot.pose(), std::vector<View>{{at(0, 0, 3)}})[0].unreachable, HasSubstr("working volume"))
      << "without being asked";
}

TEST(DriverScanner, RealMovesAreConfirmed) {
  FakeScanner fake;
  bool agree = false;
  std::vector<Pose> asked;
  fake.options.confirm = [&](const Pose& from, const Pose& to) {
    asked = {from, to};
    return agree;
  };
  DriverRobot robot(fake.connect(), at(0, 0, 1));
  fake.misbehave("die", "move");
  EXPECT_EQ(failure_of(robot.move_to({at(1, 0, 1)}, {})).kind, Failure::refused) << "and nothing is sent";
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[0].matrix(), at(0, 0, 1).matrix());
  EXPECT_EQ(asked[1].matrix(), at(1, 0, 1).matrix());
  agree = true;
  fake.behave();
  EXPECT_TRUE(std::holds_alternative<Pose>(robot.move_to({at(1, 0, 1)}, {})));
}

TEST(DriverScanner, OnlyASimulatedOneGoesBack) {
  for (const bool simulated : {true, false}) {
    FakeScanner fake(simulated ? "simulated" : "");
    int asked = 0;
    fake.options.confirm = [&](const Pose&, const Pose&) { return ++asked > 0; };
    const auto connection = fake.connect();
    DriverRobot robot(connection, at(0, 0, 1));
    robot.move_to({at(1, 0, 1)}, {});
    EXPECT_EQ(asked, simulated ? 0 : 1);
    robot.restored(at(0, 0, 1));
    EXPECT_EQ(asked, simulated ? 0 : 1);
    EXPECT_EQ(robot.pose().matrix(), at(simulated ? 0 : 1, 0, 1).matrix());
    fake.misbehave("die", "capture");
    connection->capture(1, 1, {});
    fake.behave();
    EXPECT_FALSE(connection->reconnect());
    const auto capture = connection->capture(1, 1, {});
    ASSERT_TRUE(std::holds_alternative<Capture>(capture)) << failure_of(capture).reason;
    EXPECT_EQ(std::get<Capture>(capture).T_world_camera.matrix(),
              (simulated ? at(0, 0, 1) : Pose::Identity()).matrix());
  }
}

TEST(DriverScanner, ALostDriverIsAnErrorAndNoUnreachableView) {
  const FakeScanner fake;
  DriverRobot robot(fake.connect(), at(0, 0, 1));
  fake.misbehave("die", "reach");
  EXPECT_THROW(robot.reach(robot.pose(), std::vector<View>{{at(1, 0, 1)}}), std::runtime_error);
}

TEST(DriverScanner, TheFolderIsMadeWithTheFirstCapture) {
  FakeScanner fake;
  const auto connection = fake.connect();
  EXPECT_FALSE(std::filesystem::exists(fake.options.folder));
  EXPECT_TRUE(std::holds_alternative<Capture>(connection->capture(1, 1, {})));
  fake.options.folder = fake.folder.write("file", "") / "captures";
  EXPECT_THAT(failure_of(fake.connect()->capture(1, 1, {})).reason,
              AllOf(HasSubstr("file/captures"), HasSubstr("cannot be made")));
}

TEST(DriverScanner, OptionsAreChecked) {
  const auto with = [](const auto& change) {
    FakeScanner fake;
    change(fake.options);
    return fake.refusal();
  };
  EXPECT_THAT(with([](DriverOptions& o) { o.command = "none-such"; }), HasSubstr("no such program"));
  const auto invalid = [](const auto& change) {
    FakeScanner fake;
    change(fake.options);
    EXPECT_THROW(fake.connect(), std::invalid_argument);
  };
  invalid([](DriverOptions& o) { o.command = "a 'b"; });
  invalid([](DriverOptions& o) { o.command = ""; });
  invalid([](DriverOptions& o) { o.timeout = -1.0; });
  invalid([](DriverOptions& o) { o.timeout = std::nan(""); });
  invalid([](DriverOptions& o) { o.folder.clear(); });
}

}  // namespace
}  // namespace nextview
