// The scan command as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/file/atomic_file.hpp"
#include "core/map/octree_file.hpp"
#include "tests/integration/housing_scan.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Scan, WritesEveryFileAndAPictureOfEachStep) {
  const TemporaryFolder folder;
  const Result run = nextview("scan " + housing() + coarse_housing + "--views 2 --out " + folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* file : {"config.toml",
                           "steps.csv",
                           "scores.csv",
                           "views.csv",
                           "timings.csv",
                           "metrics.json",
                           "map.ot",
                           "map.bt",
                           "cloud.ply",
                           "step_01.png",
                           "step_02.png",
                           "surface_map.ply",
                           "surface_map.stl",
                           "surface_map.png",
                           "surface_map_unseen.stl",
                           "manifest.json",
                           "journal",
                           "scans/0002.npy",
                           "surface_cloud.ply",
                           "surface_cloud.stl",
                           "surface_cloud.png",
                           "surfaces.json",
                           "state"})
    EXPECT_GT(fs::file_size(folder.path() / file), 0u) << file;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 23)
      << "something else was left behind";
  const std::string steps = read_file(folder.path() / "steps.csv");
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 3) << "a head and a row per view";
  const std::string scores = read_file(folder.path() / "scores.csv");
  EXPECT_EQ(std::count(scores.begin(), scores.end(), '\n'), 1 + 2 * 12) << "every candidate at every step";
  EXPECT_NO_THROW(read_octree(folder.path() / "map.ot"));
  EXPECT_NO_THROW(read_octree(folder.path() / "map.bt"));
}

TEST(Scan, SameConfigurationAndSeedGiveTheSameBytesOnAnyNumberOfThreads) {
  const TemporaryFolder one, two;
  ASSERT_EQ(
      nextview("--threads 1 scan " + housing() + coarse_housing + "--views 2 --out " + one.path().string()).exit_code,
      0);
  const std::string repeat =
      "--threads 2 scan --config " + (one.path() / "config.toml").string() + " --out " + two.path().string();
  ASSERT_EQ(nextview(repeat).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(one.path())) {
    const fs::path name = fs::relative(entry.path(), one.path());
    if (name == "timings.csv" || name == "scans") continue;  // the only file that may differ, and a folder
    EXPECT_TRUE(read_file(entry.path()) == read_file(two.path() / name)) << name << " differs";
  }
}

TEST(Scan, AnotherSeedGivesAnotherCloud) {
  const TemporaryFolder one, two;
  const std::string plain = "scan " + housing() + coarse_housing + "--views 1 --no-pictures --no-surfaces --out ";
  ASSERT_EQ(nextview(plain + one.path().string() + " --seed 1").exit_code, 0);
  ASSERT_EQ(nextview(plain + two.path().string() + " --seed 2").exit_code, 0);
  EXPECT_FALSE(read_file(one.path() / "cloud.ply") == read_file(two.path() / "cloud.ply"));
}

TEST(Scan, TheSimulatedCameraStaysInItsWorkingVolume) {
  const TemporaryFolder folder;
  const Result run =
      nextview("scan " + housing() + "--views 3 " + coarse_housing + "--no-pictures --no-surfaces --out " +
               folder.path().string() + " --robot.working_volume '-2 -2 0 2 2 2'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const auto& view : read_table(read_file(folder.path() / "views.csv")))
    EXPECT_GE(std::stod(view.at("z[m]")), 0.0) << "view " << view.at("view");
}

TEST(Scan, ACameraThatSeesNothingIsAViewWithoutReturns) {
  const TemporaryFolder folder;
  const Result run = nextview("scan " + housing() + "--views 3 " + coarse_housing +
                              "--sensor.max_range 0.3 --no-pictures --out " + folder.path().string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

/// By scores.csv: what each candidate was worth, at each step.
std::vector<double> gains_of(const Table& scores) {
  std::vector<double> gains;
  for (const auto& row : scores)
    for (const auto& [column, cell] : row)
      if (column.starts_with("gain[")) gains.push_back(std::stod(cell));
  return gains;
}

/// By scores.csv: the candidate of the largest utility after this step.
std::string best_after(const std::string& step, const Table& scores) {
  std::string best = "none";
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& row : scores) {
    if (row.at("step") != step || row.at("available") != "1") continue;
    const double utility = std::stod(row.at("utility"));
    if (utility > largest) best = row.at("view"), largest = utility;
  }
  return best;
}

TEST(Scan, EveryGainAndBaselineRuns) {
  // Whether each plans at all shows with few pixels, voxels and samples, too.
  const std::string tiny =
      "--map.resolution 0.04 --map.region_edge 0.72 --views.count 12 --evaluation.surface_samples 200 ";
  const std::string few_pixels = "--sensor.width 60 --sensor.height 45 ";
  const std::string pixels_for_edges = "--sensor.width 160 --sensor.height 120 ";  // points that have neighbours
  std::map<std::pair<std::string, std::string>, std::vector<double>> gains;        // by name and semantics
  std::set<std::vector<double>> published;
  for (const char* gain : {"occlusion-aware", "unobserved-voxel", "rear-side-voxel", "rear-side-entropy",
                           "proximity-count", "area-factor", "average-entropy", "combined", "random", "farthest",
                           "fixed-order", "covering-order", "set-cover", "surface-edge-density", "oracle"})
    for (const char* semantics : {"published", "reference"}) {
      SCOPED_TRACE(std::string(gain) + ", " + semantics);
      const TemporaryFolder folder;
      const Result run = nextview("scan " + housing() + tiny +
                                  (gain == std::string("surface-edge-density") ? pixels_for_edges : few_pixels) +
                                  "--no-pictures --no-surfaces --gain " + gain + " --views 2 --semantics " + semantics +
                                  " --out " + folder.path().string());
      ASSERT_EQ(run.exit_code, 0) << run.err;
      const Table scores = read_table(read_file(folder.path() / "scores.csv"));
      const std::vector<double> values = gains_of(scores);
      ASSERT_EQ(values.size(), 2u * 12u);
      EXPECT_GT(std::set<double>(values.begin(), values.end()).size(), 2u) << "it does not tell the candidates apart";
      const Table steps = read_table(read_file(folder.path() / "steps.csv"));
      ASSERT_EQ(steps.size(), 2u);
      EXPECT_EQ(steps[0].at("next_view"), best_after("1", scores));
      EXPECT_EQ(steps[1].at("view"), best_after("1", scores)) << "another view was taken than the best";
      gains[{gain, semantics}] = values;
      if (semantics == std::string("published")) published.insert(values);
    }
  // Occlusion-aware and unobserved-voxel are the same as long as no known voxel is in sight.
  EXPECT_GE(published.size(), 14u) << "different gains have the same values";
  EXPECT_NE((gains[{"occlusion-aware", "published"}]), (gains[{"occlusion-aware", "reference"}]));
  EXPECT_EQ((gains[{"farthest", "published"}]), (gains[{"farthest", "reference"}])) << "a baseline has one semantics";
}

TEST(Help, EverySubcommandHasAnExample) {
  for (const char* command : {"", "scan", "score", "refine", "calibrate", "posterior", "window", "info", "driver",
                              "export", "figure", "study", "demo", "help"}) {
    const Result run = nextview(std::string(command) + " --help");
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_THAT(run.out, HasSubstr("Examples:")) << command;
  }
  EXPECT_THAT(nextview("--version").out, HasSubstr("nextview "));
}

}  // namespace
}  // namespace nextview
