// Scanning with a live scanner, as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string noisy_camera = "--sensor.width 80 --sensor.height 60 --sensor.range_noise 0.003 ";
const std::string live_scan =
    "--views 3 --views.count 12 --evaluation.surface_samples 2000 --no-pictures --no-surfaces --seed 5 ";

class LiveScanner : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  /// The program's own simulator behind the protocol.
  static std::string simulated(const std::string& object) {
    return "--driver '\"" NEXTVIEW_PROGRAM "\" driver simulated " + object + " " + noisy_camera + "' ";
  }
  /// A driver in shell: its first words, then what it answers to each further request.
  std::string scripted(const std::string& answers) const {
    write_file(in("driver.sh"),
               "read line\necho '{\"id\":1,\"ok\":true,\"protocol\":1,\"name\":\"arm\",\"abilities\":[\"stop\"],"
               "\"intrinsics\":[70,70,40,30],\"width\":80,\"height\":60,\"max_range\":2,\"range_noise\":0.001}'\n" +
                   answers);
    return "--driver 'sh " + in("driver.sh") + "' ";
  }

  TemporaryFolder folder_;
};

TEST_F(LiveScanner, TheSimulatorBehindTheProtocolGivesTheSameFiles) {
  ASSERT_EQ(nextview("scan box " + noisy_camera + live_scan + "--out " + in("built_in")).exit_code, 0);
  const Result live = nextview("scan " + simulated("box") + live_scan + "--out " + in("live"));
  ASSERT_EQ(live.exit_code, 0) << live.err;
  EXPECT_THAT(live.out, HasSubstr("box.ply: 500 x 331 x 247 mm"));
  for (const char* file : {"map.ot", "cloud.ply", "steps.csv", "scores.csv", "views.csv"})
    EXPECT_EQ(read_file(in("built_in") + "/" + file), read_file(in("live") + "/" + file)) << file;
}

TEST_F(LiveScanner, WhatItsRobotSaidOfCandidatesIsKnownWithoutIt) {
  write_file(in("driver.sh"), "exec '" NEXTVIEW_PROGRAM "' driver simulated box " + noisy_camera +
                                  "| sed -u 's/\"reach\":\\[{[^}]*}/\"reach\":[{\"unreachable\":\"a table\"}/'\n");
  const Result live = nextview("scan --driver 'sh " + in("driver.sh") + "' " + live_scan + "--out " + in("live"));
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const std::array tables = {"steps.csv", "scores.csv"};
  std::map<std::string, std::string> written;
  for (const char* table : tables) written[table] = read_file(in("live") + "/" + table);
  EXPECT_THAT(written["scores.csv"], HasSubstr("\n1,0,0,")) << "candidate 0 is not available";
  for (const char* lost : {"state", "steps.csv", "scores.csv"}) fs::remove(in("live") + "/" + lost);
  const Result again = nextview("scan --resume " + in("live") + " --no-pictures --no-surfaces");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const char* table : tables) EXPECT_EQ(read_file(in("live") + "/" + table), written[table]) << table;
}

TEST_F(LiveScanner, TheConfigurationStartsNoProgram) {
  ASSERT_EQ(nextview("scan " + simulated("box") + live_scan + "--out " + in("live")).exit_code, 0);
  EXPECT_THAT(read_file(in("live") + "/config.toml"), testing::Not(HasSubstr("driver simulated")));
}

TEST_F(LiveScanner, WhoseObjectNobodyKnowsIsNeededAgainToGoOn) {
  write_file(in("driver.sh"),
             "exec '" NEXTVIEW_PROGRAM "' driver simulated box " + noisy_camera + "| sed -u 's/\"object\":[^,]*,//'\n");
  const Result run = nextview("scan --driver 'sh " + in("driver.sh") + "' " + live_scan +
                              "--map.region '-0.3 -0.3 -0.3 0.3 0.3 0.3' --out " + in("live"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("nextview scan --resume " + in("live") + " --driver …; nextview window"));
}

TEST_F(LiveScanner, ARealScanIsNotSimulatedInItsPlace) {
  write_file(in("scan.toml"), "driver.name = 'arm'\n");
  const Result run = nextview("scan --config " + in("scan.toml") + " " + live_scan + "--out " + in("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("scan.toml:1: driver.name: this scan was taken by the scanner arm"));
}

TEST_F(LiveScanner, ASettingThatConflictsIsAnErrorThatNamesIt) {
  const Result run = nextview("scan " + simulated("box") + live_scan + "--sensor.width 81 --out " + in("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err, "nextview: --sensor.width: the scanner has its own, 80; leave it out\n");
}

TEST_F(LiveScanner, OtherThingsToScanConflictWithIt) {
  const auto refusal = [&](const std::string& arguments) {
    const Result run = nextview("scan " + arguments + live_scan + "--out " + in("out"));
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(in("out"))) << arguments;
    return run.err;
  };
  EXPECT_THAT(refusal("bunny " + simulated("box")), HasSubstr("OBJECT and --driver do not go together"));
  EXPECT_THAT(refusal("--recorded scans " + simulated("box")), HasSubstr("--recorded and --driver do not go together"));
  write_file(in("scan.toml"), "recorded.folder = 'scans'\n");
  EXPECT_THAT(refusal("--config " + in("scan.toml") + " " + simulated("box")),
              HasSubstr("scan.toml:1: recorded.folder"));
  EXPECT_THAT(refusal("--truth bunny " + simulated("box")), HasSubstr("--truth (recorded.truth)"));
  EXPECT_THAT(refusal("--truth bunny "), HasSubstr("--truth (recorded.truth)"));
  EXPECT_THAT(refusal("--driver '' "), HasSubstr("--driver: it names no program"));
  EXPECT_THAT(refusal(simulated("box") + "--robot.position_error 0.01 "), HasSubstr("--robot.position_error"));
}

TEST_F(LiveScanner, OfAnUnknownObjectTheFirstScanSaysWhereItIsOrTheRegionIsAskedFor) {
  const std::string no_capture =
      "while read line; do id=${line#*\\\"id\\\":}; id=${id%%,*}\n"
      "echo \"{\\\"id\\\":$id,\\\"error\\\":\\\"the lens cap is on\\\"}\"; done\n";
  const Result run = nextview("scan " + scripted(no_capture) + live_scan + "--out " + in("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("the lens cap is on"));
  EXPECT_THAT(run.err, HasSubstr("unless map.region gives its box"));
}

TEST_F(LiveScanner, AMoveThatNoOneCanConfirmIsNotMade) {
  const std::string reach =
      "while read line; do case \"$line\" in *reach*) id=${line#*\\\"id\\\":}; id=${id%%,*}\n"
      "echo "
      "\"{\\\"id\\\":$id,\\\"ok\\\":true,\\\"reach\\\":[{\\\"distance\\\":1,\\\"rotation\\\":1,\\\"seconds\\\":1}]}\";;"
      "\n"
      "*move*) touch " +
      in("moved") + ";; esac; done\n";
  const Result run =
      nextview("scan " + scripted(reach) + live_scan + "--map.region '-0.2 -0.2 -0.2 0.2 0.2 0.2' --out " + in("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--driver-confirm never"));
  EXPECT_FALSE(fs::exists(in("moved")));
  EXPECT_FALSE(fs::exists(in("out"))) << "the next try may have the folder";
}

TEST_F(LiveScanner, AfterAFirstMoveThatFailedTheSameCommandTriesAgain) {
  const std::string jammed =
      "while read line; do id=${line#*\\\"id\\\":}; id=${id%%,*}\n"
      "case \"$line\" in *reach*) echo "
      "\"{\\\"id\\\":$id,\\\"ok\\\":true,\\\"reach\\\":[{\\\"distance\\\":1,\\\"rotation\\\":1,\\\"seconds\\\":1}]}\";;"
      "\n"
      "*) echo \"{\\\"id\\\":$id,\\\"error\\\":\\\"the arm is jammed\\\"}\";; esac; done\n";
  const std::string command = "scan " + scripted(jammed) + "--driver-confirm never " + live_scan +
                              "--map.region '-0.2 -0.2 -0.2 0.2 0.2 0.2' --out " + in("out");
  for (const char* attempt : {"first", "second"}) {
    const Result run = nextview(command);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, HasSubstr("the arm is jammed")) << attempt;
    EXPECT_THAT(run.err, testing::Not(HasSubstr("holds a session"))) << attempt;
  }
}

TEST_F(LiveScanner, ADriverThatCannotBeStartedIsToldInOneLine) {
  const Result run = nextview("scan --driver no-such-program --out " + in("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("no-such-program"));
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
  EXPECT_FALSE(fs::exists(in("out")));
}

}  // namespace
}  // namespace nextview
