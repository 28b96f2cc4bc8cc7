// `calibrate --fit new-surface` as a user runs it, and a scan with what it learned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string fit = "calibrate --fit new-surface";
const std::string coarse_parts = " --sensor.width 80 --sensor.height 60 --map.resolution 0.02";
const std::string few_parts = fit + " --parts 2 --views 3" + coarse_parts + " --out ";

class CalibrateNewSurface : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string read(const std::string& folder, const std::string& file) const {
    return read_file(folder_.path() / folder / file);
  }
  Json numbers(const std::string& folder) const { return Json::parse(read(folder, "calibration.json")); }
  std::string run(const std::string& arguments) const {
    const Result result = nextview(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
    return result.out;
  }
  void expect_error(const std::string& arguments, const std::string& words) const {
    const Result result = nextview(arguments + " --out " + in("refused"));
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(words)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(in("refused"))) << arguments;
  }
  const TemporaryFolder folder_;
};

TEST_F(CalibrateNewSurface, WritesTheSameBytesOnAnyNumberOfThreadsAndScanTakesThem) {
  const std::string printed = run("--threads 1 " + few_parts + in("one"));
  run("--threads 2 " + few_parts + in("two"));
  EXPECT_THAT(file_names(in("one")),
              ElementsAre("calibration.json", "config.toml", "manifest.json", "new_surface.toml"));
  for (const std::string& name : file_names(in("one")))
    EXPECT_TRUE(read("one", name) == read("two", name)) << name << " differs";

  const Json said = numbers("one");
  EXPECT_EQ(said.at("objects"), (std::vector<std::string>{"part 0", "part 1"}));
  EXPECT_EQ(said.at("views"), 3);
  EXPECT_EQ(said.at("resolutions_m"), (std::vector{0.02})) << "as given";
  EXPECT_EQ(said.at("image_widths_px"), (std::vector{80})) << "as given";
  EXPECT_EQ(said.at("range_noises_m").size(), 3u) << "mixed, as it was not given";
  EXPECT_NEAR(said.at("found_in_unmeasured").get<double>() + said.at("found_in_free").get<double>() +
                  said.at("found_in_occupied").get<double>(),
              1.0, 1e-9);
  EXPECT_GT(said.at("found_in_unmeasured").get<double>(), 0.3);

  const std::string learned = read("one", "new_surface.toml");
  EXPECT_THAT(learned, HasSubstr("2 parts made up for it, 3 views of each, seed 1"));
  run("scan box --views 2 --views.count 6 --no-pictures --no-surfaces --evaluation.surface_samples 1000" +
      coarse_parts + " --config " + in("one/new_surface.toml") + " --out " + in("scan"));
  for (const char* key :
       {"unmeasured", "unmeasured_from_free", "free", "occupied_occupied", "slant", "slant_edge_on"}) {
    EXPECT_NE(toml_value(learned, key), "") << key;
    EXPECT_NE(toml_value(learned, key), toml_value(read("one", "config.toml"), key)) << key << " is as before";
    EXPECT_EQ(toml_value(learned, key), toml_value(read("scan", "config.toml"), key)) << key;
    EXPECT_THAT(printed, HasSubstr(std::string("new_surface.") + key + " "));
  }
  EXPECT_THAT(printed, HasSubstr("nextview scan --config " + in("one/new_surface.toml")));
}

TEST_F(CalibrateNewSurface, LearnsFromMeshesAndForASensorAlone) {
  run(fit + " box sphere --views 2 --sensor.preset narrow" + coarse_parts + " --seed 3 --out " + in("out"));
  const Json said = numbers("out");
  EXPECT_EQ(said.at("objects"), (std::vector<std::string>{"box", "sphere"}));
  EXPECT_EQ(said.at("seed"), 3);
  EXPECT_EQ(said.at("range_noises_m"), (std::vector{0.0001})) << "the sensor's";
  EXPECT_THAT(read("out", "new_surface.toml"), HasSubstr("box, sphere"));
}

TEST_F(CalibrateNewSurface, TheProgramsOwnIsAConfigurationOfThisName) {
  run("scan box --views 1 --views.count 4 --no-pictures --no-surfaces --evaluation.surface_samples 100" + coarse_parts +
      " --new_surface.free 3 --config new_surface --new_surface.occupied 2 --out " + in("scan"));
  EXPECT_EQ(toml_value(read("scan", "config.toml"), "occupied"), "2") << "options override";
}

TEST_F(CalibrateNewSurface, MistakesAreOneLineAndExitCode2) {
  for (const char* option : {"--held-out box", "--range-dependent", "--keep-clamps", "--band 2", "--voxel 0.1",
                             "--stand-off 2", "--gibbs.sweeps 5"}) {
    const std::string text = option;
    expect_error(fit + " " + text, text.substr(0, text.find(' ')) + " has no meaning with --fit new-surface");
  }
  expect_error("calibrate --parts 3", "--parts has no meaning with --fit sensor-model");
  expect_error(fit + " box --parts 3", "--parts");
  expect_error(fit + " --parts 0", "--parts");
  expect_error(fit + " --views 3,4", "--views");
  expect_error(fit + " ''", "no name");
  expect_error(fit + " no-such-object", "no-such-object");
  expect_error(fit + " " + folder_.path().string(), "finished scans");
  expect_error(fit + " scene.txt", "finished scans");
  expect_error("calibrate --fit surface", "--fit");
  expect_error(fit + " --map.region_edge 0.3" + coarse_parts + " box", "map.region_edge");
  expect_error(fit + " --map.region_edge 40", "map.region_edge");
  expect_error(fit + " --planner.gain random", "--planner.gain");
}

TEST_F(CalibrateNewSurface, CtrlCStopsIt) {
  const Result result = nextview_interrupted(0.4, fit + " --no-pictures --out " + in("out"));
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_FALSE(std::filesystem::exists(in("out/new_surface.toml")));
}

}  // namespace
}  // namespace nextview
