// Going through recorded data, as a user does.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "core/map/octree_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const std::string maps_alone = "--no-pictures --no-surfaces ";

class RecordedScan : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string scan_of_a_plate() const {
    const std::string small =
        "--views 4 --views.count 12 --sensor.width 120 --sensor.height 90 --evaluation.surface_samples 2000 ";
    EXPECT_EQ(nextview("scan slotted_plate " + small + maps_alone + "--out " + in("scan")).exit_code, 0);
    return in("scan");
  }

  TemporaryFolder folder_;
};

TEST_F(RecordedScan, ReplayedInItsOrderGivesItsFiles) {
  const std::string scan = scan_of_a_plate();
  const Result run =
      nextview("scan --recorded " + scan + " --gain fixed-order " + maps_alone + "--out " + in("replay"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("scan: 4 recorded frames"), HasSubstr("planned   recorded   random")));
  for (const char* file : {"map.ot", "map.bt", "cloud.ply"})
    EXPECT_EQ(read_file(scan + "/" + file), read_file(in("replay") + "/" + file)) << file;
  EXPECT_THAT(read_file(in("replay") + "/orders.csv"), HasSubstr("\n1,0,step 1,"));
  // And what was made of a recording can be refined, and gone through again.
  EXPECT_EQ(nextview("refine " + in("replay") + " --no-pictures --out " + in("refined")).exit_code, 0);
  const Result again = nextview("scan " + in("replay") + " --gain fixed-order " + maps_alone + "--out " + in("again"));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_file(scan + "/map.ot"), read_file(in("again") + "/map.ot"));
}

/// What a scan was ended by is its own affair; what it was scanned with is not.
TEST_F(RecordedScan, HasTheSettingsOfTheScanButItsEnd) {
  ASSERT_EQ(nextview("scan box --views 2 --views.count 12 --sensor.width 80 --sensor.height 60 "
                     "--evaluation.surface_samples 500 --termination.coverage 0.99 " +
                     maps_alone + "--out " + in("scan"))
                .exit_code,
            0);
  ASSERT_EQ(nextview("scan --recorded " + in("scan") + " " + maps_alone + "--out " + in("out")).exit_code, 0);
  EXPECT_THAT(read_file(in("scan") + "/config.toml"),
              AllOf(HasSubstr("\ncoverage = 0.99 "), HasSubstr("\nwidth = 80 ")));
  EXPECT_THAT(read_file(in("out") + "/config.toml"), AllOf(HasSubstr("\ncoverage = 0 "), HasSubstr("\nwidth = 80 ")));
}

/// Around the points, whatever their extents.
TEST_F(RecordedScan, TheRegionIsAroundThePoints) {
  const fs::path folder = folder_.path() / "clouds";
  fs::create_directories(folder);
  std::string points;
  for (int i = 0; i < 400; ++i)
    points += fmt::format("{} {} {}\n", 0.01 * (i % 20), 0.02 * (i / 20), 1.0 + 0.005 * (i % 7));
  write_file(folder / "a.ply",
             "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n" +
                 points);
  write_file(folder / "poses.txt", "0 0 0 0 0 0 1\n");
  const Result run = nextview("scan --recorded " + folder.string() + " " + maps_alone + "--out " + in("out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string config = read_file(in("out") + "/config.toml");
  const std::size_t at = config.find("\nregion = '");
  ASSERT_NE(at, config.npos) << config;
  std::istringstream numbers(config.substr(at + 11));
  std::array<double, 6> region{};
  for (double& number : region) numbers >> number;
  const std::array<double, 3> low = {0, 0, 1}, high = {0.19, 0.38, 1.03};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LE(region[axis], low[axis]) << axis;
    EXPECT_GE(region[axis], low[axis] - 0.2) << axis;
    EXPECT_GE(region[axis + 3], high[axis]) << axis;
    EXPECT_LE(region[axis + 3], high[axis] + 0.2) << axis;
  }
}

TEST_F(RecordedScan, IsComparedWithATruthThatIsFound) {
  const Result run = nextview("scan --recorded " + scan_of_a_plate() + " --truth slotted_plate --start 2 " +
                              maps_alone + "--out " + in("out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("of its points lie on slotted_plate.ply"));
  EXPECT_THAT(run.out, AllOf(HasSubstr("% shown"), HasSubstr("of the true surface, of which ")));
  EXPECT_THAT(run.out, Not(HasSubstr("some candidate can see"))) << "its rows are shares of what all frames show";
  EXPECT_THAT(read_file(in("out") + "/metrics.json"), AllOf(HasSubstr("\"alignment\""), HasSubstr("\"accuracy_m\"")));
}

TEST_F(RecordedScan, MistakesAreOneLine) {
  const std::string scan = scan_of_a_plate();
  const auto complaint = [&](const std::string& arguments) {
    const Result run = nextview("scan " + arguments + " --out " + in("none"));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(complaint("--recorded " + in("missing")), HasSubstr("missing: there is no such file or folder"));
  fs::create_directory(in("empty"));
  EXPECT_THAT(complaint("--recorded " + in("empty")), HasSubstr("is an empty folder"));
  write_file(in("empty") + "/notes.txt", "");
  EXPECT_THAT(complaint("--recorded " + in("empty")), HasSubstr("--write-dataset"));
  EXPECT_THAT(complaint("--recorded " + scan + " --start 17"),
              HasSubstr("--start (recorded.start): there is no frame '17'"));
  EXPECT_THAT(complaint("box --recorded " + scan), HasSubstr("--truth box"));
  EXPECT_THAT(complaint("--recorded " + scan + " --sensor.height 7"), HasSubstr("--sensor.height: the recording has"));
  EXPECT_THAT(complaint("--recorded " + scan + " --map.region '5 5 5 6 6 6'"),
              HasSubstr("no frame has a point within"));
}

TEST_F(RecordedScan, AMapIsWhatAnotherScanBeginsWith) {
  const std::string scan = scan_of_a_plate();
  const std::string small =
      "scan slotted_plate --views 1 --views.count 12 --sensor.width 120 --sensor.height 90 --evaluation.enabled false ";
  ASSERT_EQ(nextview(small + "--map.start " + scan + "/map.ot " + maps_alone + "--out " + in("more")).exit_code, 0);
  const auto measured = [](const std::string& folder) {
    const OccupancyMap map = read_octree(folder + "/map.ot");
    return std::ranges::count_if(map.voxels(), &Voxel::measured);
  };
  ASSERT_EQ(nextview(small + maps_alone + "--out " + in("without")).exit_code, 0);
  EXPECT_LT(measured(in("without")), measured(scan) * 9 / 10) << "one view alone shows less";
  EXPECT_GE(measured(in("more")), measured(scan)) << "something of it is lost";
  const Result alone = nextview("scan " + scan + "/map.ot " + maps_alone + "--out " + in("alone"));
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, HasSubstr("a map alone"));
}

TEST_F(RecordedScan, RealRangeImagesAreGoneThroughByAnyPlanner) {
  const fs::path bunny = fs::path(NEXTVIEW_SHARED_DIR) / "data/scans/stanford_bunny";
  if (!fs::exists(bunny)) GTEST_SKIP() << "an addition: " << bunny << " is not there";
  for (const char* gain : {"new-surface", "occlusion-aware", "random"}) {
    const Result run =
        nextview("scan --recorded " + bunny.string() + " --gain " + gain + " " + maps_alone + "--out " + in(gain));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("Finished: 10 views taken."));
  }
}

}  // namespace
}  // namespace nextview
