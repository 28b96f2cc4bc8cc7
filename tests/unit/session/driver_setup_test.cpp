// What a configuration follows of what a scanner says of itself.
#include "core/session/driver_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file/npy_file.hpp"
#include "core/sensor/depth_image.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class DriverSetup : public testing::Test {
 protected:
  DriverSetup() { c_.map.region = "-0.1 -0.1 0 0.1 0.1 0.2"; }

  /// Greets a driver that says this too, and runs this where it is asked more.
  void connect(const std::string& more = {}, const std::string& then = {}) {
    const std::string hello = R"({"id":1,"ok":true,"protocol":1,"name":"canned","abilities":[],)"
                              R"("intrinsics":[4,4,1.5,1],"width":4,"height":3,"max_range":9,"range_noise":0.001)";
    const auto script = folder_.write("driver.sh", "read line\necho '" + hello + more + "}'\nread line\n" + then);
    connect_scanner(c_, {"sh '" + script.string() + "'"});
  }
  std::string refusal(const std::string& more = {}) {
    try {
      connect(more);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "it is connected";
  }

  /// Why nothing comes of a scanner whose region its first scan is to show, where it runs this then.
  std::string first_scan_fails(const std::string& then) {
    c_ = {};
    try {
      connect({}, then);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it is connected";
  }

  TemporaryFolder folder_;
  Configuration c_;
};

TEST_F(DriverSetup, RaysGetThroughTheRegionFromWhereTheScannerStands) {
  connect();
  EXPECT_LT(c_.planner.ray_length, 1.0);
  for (const char* key : {R"(,"start":)", R"(,"views":[)"}) {
    c_ = {};
    c_.map.region = "-0.1 -0.1 0 0.1 0.1 0.2";
    connect(std::string(key) + "[1,0,0,0,0,1,0,0,0,0,1,5,0,0,0,1]" + (std::string(key).ends_with('[') ? "]" : ""));
    EXPECT_GT(c_.planner.ray_length, 5.0) << key;
  }
}

// Of who simulates what it does not tell nobody can repeat the scan.
TEST_F(DriverSetup, ASimulatorOfAnUnknownObjectIsNeededAgain) {
  connect(R"(,"abilities":["simulated"])");
  EXPECT_EQ(c_.driver.name, "canned");
  connect(R"(,"abilities":["simulated"],"object":"box")");
  EXPECT_EQ(c_.driver.name, "");
}

TEST_F(DriverSetup, AConflictIsNamedOnce) {
  give(c_, "sensor.width", "100", "--width (sensor.width)");
  EXPECT_EQ(refusal(), "--width (sensor.width): the scanner has its own, 4; leave it out");
  give(c_, "sensor.width", "100", "sensor.width", "a.toml:3");
  EXPECT_EQ(refusal(), "a.toml:3: sensor.width: the scanner has its own, 4; leave it out");
}

TEST_F(DriverSetup, ASimulatorsSettingsAreFollowed) {
  connect(R"(,"settings":{"sensor.dropout":"0.25","object.longest_side":"0.1"})");
  EXPECT_EQ(c_.sensor.dropout, 0.25);
  EXPECT_EQ(c_.object.longest_side, 0.1);
  EXPECT_THAT(refusal(R"(,"settings":{"seed":"5"})"), HasSubstr("'seed'"));
  EXPECT_THAT(refusal(R"(,"settings":{"sensor.none":"5"})"), HasSubstr("'sensor.none'"));
  EXPECT_THAT(refusal(R"(,"settings":{"object.file":"/etc/passwd"})"), HasSubstr("'object.file'"));
  give(c_, "sensor.dropout", "0.1", "--sensor.dropout");
  EXPECT_THAT(refusal(R"(,"settings":{"sensor.dropout":"0.25"})"),
              StartsWith("--sensor.dropout: the scanner has its own, 0.25"));
}

// Without a region the object is looked for in a first scan. That a region would do helps whoever can look elsewhere.
TEST_F(DriverSetup, AFirstScanThatFailsIsToldWithWhatHelps) {
  EXPECT_EQ(first_scan_fails(R"(echo '{"id":2,"error":"it is dark"}')"),
            "driver canned: capture: it is dark; the first scan is to show where the object stands, unless map.region "
            "gives its box: six numbers [m]");
  EXPECT_EQ(first_scan_fails("exit 3"), "driver canned: it ended with exit code 3");
  EXPECT_EQ(first_scan_fails("echo done"),
            "driver canned: capture: its answer is no JSON (what is for people goes to standard error): done");
}

/// What is wrong with a file is wrong wherever the object stands; where nothing was in sight its box helps.
TEST_F(DriverSetup, ARegionIsAskedForWhereNothingWasSeenNotWhereTheCaptureIsWrong) {
  const auto captures = [&](const std::string& file) {
    const std::string identity = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
    return first_scan_fails(R"(echo '{"id":2,"ok":true,"pose":)" + identity + R"(,"file":")" + file + "\"}'");
  };
  const std::string file = (folder_ / "capture.npy").string();
  const std::string begin = "driver canned: capture: " + file + ": ";
  write_npy({4, 4, std::vector<float>(16, 0.5f)}, file);
  EXPECT_EQ(captures(file), begin + "has 4 x 4 pixels; the driver's camera has 4 x 3");
  write_npy({4, 3, std::vector<float>(12, DepthImage::invalid)}, file);
  EXPECT_EQ(captures(file), begin +
                                "nothing was measured: it holds neither a range nor a free way; the first scan is to "
                                "show where the object stands, unless map.region gives its box: six numbers [m]");
  folder_.write("capture.npy", "no table");
  EXPECT_THAT(captures(file), AllOf(StartsWith(begin), Not(HasSubstr("map.region"))));
  EXPECT_THAT(captures((folder_ / "none.npy").string()), AllOf(HasSubstr("none.npy"), Not(HasSubstr("map.region"))));
}

TEST_F(DriverSetup, MadeUpErrorsOfARobotAreRefused) {
  for (const char* key : {"robot.position_error", "robot.rotation_error"}) {
    c_ = {};
    give(c_, key, "0.005", key);
    EXPECT_THAT(refusal(), StartsWith(key));
  }
}

}  // namespace
}  // namespace nextview
