// Our simulator behind the driver protocol is the simulator.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/driver/driver_scanner.hpp"
#include "core/file/read_file.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/session.hpp"
#include "core/session/session_parts.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Configuration small_scan(const std::string& object, bool evaluated) {
  Configuration c;
  c.object.file = object;
  c.seed = 7;
  c.sensor.width = 80;
  c.sensor.height = 60;
  c.sensor.dropout = 0.1;
  c.sensor.outliers = 0.05;
  c.map.resolution = 0.02;
  c.views.count = 12;
  c.planner.ray_columns = 16;
  c.planner.ray_rows = 12;
  c.evaluation.enabled = evaluated;
  c.evaluation.surface_samples = 2000;
  c.termination.views = 4;
  c.termination.surface_left = 0.0;
  return c;
}

DriverOptions simulated(const std::string& object, const std::filesystem::path& folder, const std::string& more = {}) {
  return {.command = fmt::format("env -u DISPLAY '{}' driver simulated '{}' --sensor.width 80 --sensor.height 60 "
                                 "--sensor.dropout 0.1 --sensor.outliers 0.05 {}",
                                 NEXTVIEW_PROGRAM, object, more),
          .timeout = 60.0,
          .folder = folder};
}

/// The parts of a session that has its scans from a driver.
SessionParts parts_of(const std::shared_ptr<DriverConnection>& connection, const Configuration& c) {
  SessionParts parts;
  parts.source = std::make_unique<DriverSource>(connection, c.seed);
  parts.robot = std::make_unique<DriverRobot>(connection, Pose::Identity());
  return parts;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_the_same(const Session& driven, const Session& plain) {
  ASSERT_EQ(driven.records().size(), plain.records().size());
  for (std::size_t k = 0; k < plain.records().size(); ++k) {
    const StepRecord &a = driven.records()[k], &b = plain.records()[k];
    EXPECT_TRUE(same_bytes(driven.scans()[k]->hits, plain.scans()[k]->hits)) << k;
    EXPECT_TRUE(same_bytes(driven.scans()[k]->misses, plain.scans()[k]->misses)) << k;
    EXPECT_EQ(driven.scans()[k]->origin, plain.scans()[k]->origin);
    EXPECT_EQ(a.T_world_camera.matrix(), b.T_world_camera.matrix()) << k;
    EXPECT_EQ(a.view, b.view);
    EXPECT_EQ(a.gain, b.gain);
    EXPECT_EQ(a.utility, b.utility);
    EXPECT_EQ(a.motion.distance, b.motion.distance);
    EXPECT_EQ(a.motion.rotation, b.motion.rotation);
    EXPECT_EQ(a.motion.seconds, b.motion.seconds);
    EXPECT_EQ(a.entropy, b.entropy);
  }
}

TEST(DriverSimulated, GivesTheBytesOfTheBuiltInSource) {
  const TemporaryFolder folder;
  for (const char* object : {"box", "slotted_plate"}) {
    const Configuration c = small_scan(object, true);
    Session plain(c);
    const auto connection = std::make_shared<DriverConnection>(simulated(object, folder / "captures"));
    EXPECT_EQ(connection->greeting().object, plain.object_file().string());
    Session driven(c, parts_of(connection, c));
    while (plain.finished().empty()) plain.step();
    while (driven.finished().empty()) driven.step();
    ASSERT_EQ(plain.records().size(), 4u);
    ASSERT_GT(plain.scans().front()->hits.size(), 50u);
    expect_the_same(driven, plain);
  }
}

TEST(DriverSimulated, ASessionFollowsItsSettings) {
  const char* const options[][2] = {{"object.longest_side", "0.2"}, {"sensor.preset", "narrow"},
                                    {"sensor.width", "80"},         {"sensor.height", "60"},
                                    {"sensor.dropout", "0.1"},      {"sensor.grazing_limit", "70"}};
  std::string command = fmt::format("env -u DISPLAY '{}' driver simulated box", NEXTVIEW_PROGRAM);
  Configuration c;
  c.object.file = resolve_object("box").string();
  c.evaluation.surface_samples = 2000;
  c.views.count = 12;
  Configuration plain_one = c;
  for (const auto& [key, text] : options) {
    command += fmt::format(" --{} {}", key, text);
    give(plain_one, key, text, key);
  }
  const auto connection = connect_scanner(c, {command});
  Session driven(c, scanner_parts(c, connection)), plain(plain_one);
  EXPECT_EQ(to_toml(driven.configuration()), to_toml(plain.configuration()));
  for (int step = 0; step < 2; ++step) {
    plain.step();
    driven.step();
  }
  expect_the_same(driven, plain);
}

TEST(DriverSimulated, NeedsNoObjectInTheSession) {
  const TemporaryFolder folder;
  const Configuration c = small_scan("box", false);
  const auto connection = std::make_shared<DriverConnection>(simulated("box", folder / "captures"));
  Session plain(c), driven(c, parts_of(connection, c));
  for (int step = 0; step < 3; ++step) {
    plain.step();
    driven.step();
  }
  expect_the_same(driven, plain);
}

TEST(DriverSimulated, GoesBackAndOnAndSurvivesItsDriver) {
  const TemporaryFolder folder;
  const Configuration c = small_scan("box", false);
  const auto connection = std::make_shared<DriverConnection>(simulated("box", folder / "captures"));
  Session plain(c), driven(c, parts_of(connection, c));
  plain.step();
  driven.step();
  const ScanState before = driven.state();
  plain.step();
  driven.step();
  driven.restore(before);
  driven.step();
  expect_the_same(driven, plain);
  EXPECT_FALSE(connection->reconnect());
  plain.step();
  driven.step();
  expect_the_same(driven, plain);
}

TEST(DriverSimulated, StandsWhereItIsConfigured) {
  const TemporaryFolder folder;
  Configuration c = small_scan("box", false);
  const DriverConnection connection(simulated("box", folder / "captures", "--planner.start_azimuth 30"));
  load_object(c);
  c.planner.start_azimuth = 30.0;
  EXPECT_EQ(connection.greeting().start->matrix(), configured_start_view(c).matrix());
  EXPECT_TRUE(connection.is_simulated() && connection.greeting().can("stop"));
}

TEST(DriverSimulated, SaysWhatIsWrongWithItsOptions) {
  const TemporaryFolder folder;
  const auto reason = [&](const std::string& object, const std::string& more) -> std::string {
    try {
      DriverConnection connection(simulated(object, folder / "captures", more));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it is connected";
  };
  EXPECT_THAT(reason("none.ply", ""), AllOf(HasSubstr("exit code 2"), HasSubstr("none.ply")));
  EXPECT_THAT(reason("box", "--sensor.max_range -1"), AllOf(HasSubstr("exit code 2"), HasSubstr("sensor.max_range")));
}

TEST(DriverSimulated, CanBeSpokenToFromAShell) {
  const TemporaryFolder folder;
  const std::string answers = (folder / "answers").string();
  const std::string command =
      "echo '{\"id\": 1, \"request\": \"hello\", \"protocol\": 1}' | env -u DISPLAY '" NEXTVIEW_PROGRAM
      "' driver simulated box >'" +
      answers + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read_file(answers), AllOf(HasSubstr("\"ok\":true"), HasSubstr("\"abilities\":[\"stop\",\"simulated\"]")));
}

}  // namespace
}  // namespace nextview
