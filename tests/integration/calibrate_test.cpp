// The calibrate command as a user runs it, and scans with what it fitted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// Gibbs maps that take a tenth of a second: few pixels, coarse voxels.
const std::string coarse_calibration =
    " --sensor.width 60 --sensor.height 45 --map.resolution 0.04 --evaluation.surface_samples 1000 ";
const std::string small_calibration = coarse_calibration + "--views 3 --no-pictures --out ";
const std::string sphere_and_box = "calibrate sphere --held-out box";

class Calibrate : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string read(const std::string& folder, const std::string& file) const {
    return read_file(folder_.path() / folder / file);
  }
  void run(const std::string& arguments) const {
    const Result result = nextview(arguments);
    ASSERT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  void expect_error(const std::string& arguments, const std::string& word) const {
    const Result result = nextview(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(word)) << arguments;
    EXPECT_FALSE(fs::exists(folder_.path() / "out" / "sensor_model.toml")) << arguments;
  }
  const TemporaryFolder folder_;
};

const std::vector<std::string> fitted_keys = {"hit", "miss", "hit_decay", "miss_decay", "clamp_min", "clamp_max"};

TEST_F(Calibrate, WritesTheModelTheNumbersAndThePictureAndNothingElse) {
  run(sphere_and_box + coarse_calibration + "--views 2,4 --out " + in("out"));
  EXPECT_THAT(file_names(in("out")),
              ::testing::ElementsAre("calibration.json", "calibration.png", "config.toml", "descent.csv",
                                     "manifest.json", "scores.csv", "sensor_model.toml"));
  const Table scores = read_table(read("out", "scores.csv"));
  ASSERT_EQ(scores.size(), 2u * 2u * 3u) << "two objects, two numbers of views, three maps";
  for (std::size_t row = 0; row < scores.size(); row += 3) {
    const auto &before = scores[row], &after = scores[row + 1], &gibbs = scores[row + 2];
    EXPECT_EQ(before.at("map") + after.at("map") + gibbs.at("map"), "beforeaftergibbs");
    EXPECT_EQ(before.at("object"), row < 6 ? "sphere" : "box");
    EXPECT_EQ(before.at("held_out"), row < 6 ? "0" : "1");
    EXPECT_EQ(before.at("views"), row % 6 == 0 ? "2" : "4");
    EXPECT_GT(std::stoul(before.at("voxels")), 500u);
    const auto cross_entropy = [](const auto& r) { return std::stod(r.at("cross_entropy[nats]")); };
    EXPECT_LT(cross_entropy(after), cross_entropy(before)) << row;
    EXPECT_LE(cross_entropy(gibbs), cross_entropy(after)) << "no map has less than the entropy of the Gibbs map";
    EXPECT_GT(cross_entropy(gibbs), 0.0);
    EXPECT_NE(before.at("log_loss_touch_near_surface[nats]"), after.at("log_loss_touch_near_surface[nats]"));
  }
  const Table descent = read_table(read("out", "descent.csv"));
  ASSERT_GT(descent.size(), 3u);
  for (const std::string& key : fitted_keys) {
    const std::string column = key.ends_with("decay") ? key + "[1/m]" : key;
    EXPECT_EQ(descent.back().at(column), toml_value(read("out", "sensor_model.toml"), key)) << "ends at the model";
  }
  EXPECT_LT(std::stod(descent.back().at("cross_entropy[nats]")), std::stod(descent[0].at("cross_entropy[nats]")));
}

TEST_F(Calibrate, TheSameBytesOnAnyNumberOfThreads) {
  const std::string rest = coarse_calibration + "--views 4 --range-dependent --no-pictures --out ";
  run("--threads 1 " + sphere_and_box + rest + in("one"));
  run("--threads 2 " + sphere_and_box + rest + in("two"));
  for (const std::string& name : file_names(in("one"))) {
    EXPECT_TRUE(read("one", name) == read("two", name)) << name << " differs";
  }
  EXPECT_EQ(file_names(in("one")).size(), 6u);
}

TEST_F(Calibrate, ScanTakesTheModelAloneAndWithOtherFiles) {
  run(sphere_and_box + small_calibration + in("out"));
  const std::string model = read("out", "sensor_model.toml");
  const std::string scan = "scan box --views 1 --views.count 4 --no-pictures --no-surfaces" + coarse_calibration;
  run(scan + "--config " + in("out/sensor_model.toml") + " --out " + in("alone"));
  write_file(in("other.toml"), "seed = 9\n[map]\nhit = 0.6\noccupied_above = 0.9\n");
  const std::string other = " --config " + in("other.toml"), fitted = " --config " + in("out/sensor_model.toml");
  run(scan + other + fitted + " --out " + in("fitted_last"));
  run(scan + fitted + other + " --out " + in("other_last"));
  for (const std::string& key : fitted_keys) {
    ASSERT_NE(toml_value(model, key), "") << key;
    EXPECT_EQ(toml_value(read("alone", "config.toml"), key), toml_value(model, key));
    EXPECT_EQ(toml_value(read("fitted_last", "config.toml"), key), toml_value(model, key));
    EXPECT_EQ(toml_value(read("other_last", "config.toml"), key), key == "hit" ? "0.6" : toml_value(model, key));
  }
  EXPECT_NE(toml_value(model, "hit"), "0.7");
  EXPECT_EQ(toml_value(read("alone", "config.toml"), "occupied_above"), "0.8") << "the file sets nothing else";
  EXPECT_EQ(toml_value(read("fitted_last", "config.toml"), "occupied_above"), "0.9");
  EXPECT_EQ(toml_value(read("fitted_last", "config.toml"), "seed"), "9");
  EXPECT_FALSE(read("alone", "map.ot") == read("other_last", "map.ot")) << "the map is made with the model";
}

TEST_F(Calibrate, DecaysAreFittedAndClampsKeptOnlyIfAsked) {
  const std::string sphere = "calibrate sphere --held-out sphere", start = " --map.clamp_min 0.15 --map.clamp_max 0.9";
  run(sphere + " --range-dependent" + start + small_calibration + in("ranges"));
  const std::string ranges = read("ranges", "sensor_model.toml");
  EXPECT_NE(std::stod(toml_value(ranges, "hit_decay")), 0.0);
  EXPECT_NE(std::stod(toml_value(ranges, "miss_decay")), 0.0);
  EXPECT_NE(toml_value(ranges, "clamp_min"), "0.15");
  EXPECT_NE(toml_value(ranges, "clamp_max"), "0.9");
  run(sphere + " --keep-clamps --map.miss_decay 0.25" + start + small_calibration + in("kept"));
  const std::string kept = read("kept", "sensor_model.toml");
  EXPECT_EQ(toml_value(kept, "clamp_min"), "0.15");
  EXPECT_EQ(toml_value(kept, "clamp_max"), "0.9");
  EXPECT_EQ(toml_value(kept, "miss_decay"), "0.25") << "not fitted, so it stays";
  EXPECT_NE(toml_value(kept, "hit"), "0.7");
}

TEST_F(Calibrate, TakesFinishedScansToo) {
  run("scan box --views 2 --views.count 6 --no-pictures --no-surfaces" + coarse_calibration + "--out " + in("scan"));
  write_file(in("scene.txt"), wall_scene(0.04));
  // A trailing slash, as a shell completes it; the scan that is fitted to is not held out as well.
  run("calibrate " + in("scan") + "/ " + in("scene.txt") + " --held-out " + in("scan") + " --no-pictures --out " +
      in("out"));
  const Table scores = read_table(read("out", "scores.csv"));
  ASSERT_EQ(scores.size(), 2u * 3u);
  EXPECT_EQ(scores[0].at("object"), "box");
  EXPECT_EQ(scores[0].at("views"), "2");
  EXPECT_EQ(scores[3].at("object"), "scene");
  EXPECT_EQ(scores[3].at("views"), "1");
  EXPECT_EQ(scores[3].at("log_loss_touch_near_surface[nats]"), "") << "nothing is known of a recorded scene";
  for (const auto& row : scores) EXPECT_EQ(row.at("held_out"), "0");
}

TEST_F(Calibrate, AScanAsInputHasNothingHeldOutUnlessAskedForAndIsNotOverwritten) {
  run("scan box --views 2 --views.count 6 --no-pictures --no-surfaces" + coarse_calibration + "--out " + in("scan"));
  run("calibrate " + in("scan") + " --no-pictures --out " + in("first"));
  EXPECT_EQ(read_table(read("first", "scores.csv")).size(), 3u);
  const std::string before = read("scan", "scores.csv");
  expect_error("calibrate " + in("scan") + " --no-pictures --out " + in("scan"), "another folder");
  expect_error("calibrate " + in("scan") + " --views 9 --no-pictures --out " + in("second"), "--views is of objects");
  EXPECT_EQ(read("scan", "scores.csv"), before);
}

TEST_F(Calibrate, OptionsDoNotSwallowInputs) {
  run("calibrate --held-out box --views 3 sphere --no-pictures" + coarse_calibration + "--out " + in("out"));
  const Table scores = read_table(read("out", "scores.csv"));
  ASSERT_EQ(scores.size(), 2u * 3u);
  EXPECT_EQ(scores[0].at("object") + scores[0].at("held_out"), "sphere0");
  EXPECT_EQ(scores[3].at("object") + scores[3].at("held_out"), "box1");
}

// sensor_model.toml says so, and the noise decides what is fitted.
TEST_F(Calibrate, TheSensorIsThatOfTheConfigurationBesideTheModel) {
  run("scan box --views 2 --views.count 6 --no-pictures --no-surfaces --sensor.range_noise 0.006" + coarse_calibration +
      "--out " + in("scan"));
  run("calibrate " + in("scan") + " --held-out " + in("scan") + " --no-pictures --out " + in("out"));
  EXPECT_THAT(read("out", "sensor_model.toml"), HasSubstr("the sensor of the config.toml beside it"));
  EXPECT_EQ(toml_value(read("out", "config.toml"), "range_noise"), "0.006");
  EXPECT_EQ(toml_value(read("out", "config.toml"), "width"), "60");
}

TEST_F(Calibrate, BadInputIsOneLineAndExitCode2) {
  expect_error("calibrate no-such-object" + small_calibration + in("out"), "no-such-object");
  expect_error("calibrate sphere --held-out no-such-object" + small_calibration + in("out"), "no-such-object");
  expect_error(sphere_and_box + coarse_calibration + "--views 0 --out " + in("out"), "--views");
  expect_error(sphere_and_box + coarse_calibration + "--views 2,many --out " + in("out"), "--views");
  expect_error(sphere_and_box + small_calibration + in("out") + " --band -1", "--band");
  expect_error(sphere_and_box + small_calibration + in("out") + " --map.hit 0.3", "hit");
  expect_error(sphere_and_box + small_calibration + in("out") + " --planner.gain gibbs", "--planner.gain");
  write_file(in("file"), "not a folder");
  expect_error(sphere_and_box + small_calibration + in("file"), in("file"));
  EXPECT_EQ(read_file(in("file")), "not a folder");
  expect_error(sphere_and_box + small_calibration + "/proc/nextview", "/proc/nextview");
}

TEST_F(Calibrate, VoxelsOfTwoSizesAreRefused) {
  const std::string scan =
      "scan box --views 1 --views.count 4 --no-pictures --no-surfaces --sensor.width 40 "
      "--sensor.height 30 --evaluation.surface_samples 100 --map.resolution ";
  run(scan + "0.04 --out " + in("coarse"));
  run(scan + "0.05 --out " + in("coarser"));
  const std::string rest = " --no-pictures --out " + in("out");
  expect_error("calibrate " + in("coarse") + " " + in("coarser") + rest, "0.05");
  expect_error("calibrate " + in("coarse") + " --held-out " + in("coarser") + rest, "0.05");
}

// A camera that reaches nothing leaves no voxel to fit to: a reason for people, not for programmers.
TEST_F(Calibrate, NothingToFitToIsSaidSo) {
  expect_error(sphere_and_box + " --sensor.max_range 0.3" + small_calibration + in("out"),
               "sphere: there is nothing to fit to: no view met a surface");
}

TEST_F(Calibrate, ViewsOfASmallPartAreAsNearAsScanTakesThem) {
  run(sphere_and_box +
      " --object.longest_side 0.1 --sensor.width 60 --sensor.height 45 --evaluation.surface_samples 1000 --views 3 "
      "--no-pictures --out " +
      in("out"));
  EXPECT_THAT(read("out", "sensor_model.toml"), HasSubstr("voxels of 0.002 m"));
}

// Objects are taken as `scan` takes them.
TEST_F(Calibrate, AnObjectLargerThanTheRegionIsRefusedAsByScan) {
  expect_error("scan sphere --map.region_edge 0.4" + small_calibration + in("out"), "map.region_edge");
  expect_error(sphere_and_box + " --map.region_edge 0.4" + small_calibration + in("out"), "map.region_edge");
}

// The exit code of every command that its user stops.
// Who leaves an option out learns there what it is then.
TEST_F(Calibrate, ItsHelpTellsBoundsAndDefaults) {
  const Result help = nextview("help calibrate");
  ASSERT_EQ(help.exit_code, 0) << help.err;
  for (const char* told : {"INPUT TEXT=[bunny,slotted_plate]", "--fit TEXT:{sensor-model,new-surface}=sensor-model",
                           "--views INT:in [1 - 100]=[4,20]", "--parts INT:in [1 - 1000]=24",
                           "--band INT:in [0 - 100]=3", "--out DIR=calibration",
                           "--voxel FLOAT:0 or from 0.1 mm to 1 m=0", "--stand-off FLOAT:from 10 mm to 100 m=0.7"})
    EXPECT_THAT(help.out, HasSubstr(told));
}

TEST_F(Calibrate, CtrlCStopsIt) {
  const Result result = nextview_interrupted(
      0.4, "calibrate sphere --held-out box --no-pictures --sensor.width 320 --sensor.height 240 --out " + in("out"));
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_FALSE(fs::exists(in("out/sensor_model.toml")));
}

}  // namespace
}  // namespace nextview
