// Going through recorded data, as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string quick = "--no-pictures --no-surfaces ";

class RecordedScan : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string scan_of_a_plate() const {
    const std::string small =
        "--views 4 --views.count 12 --sensor.width 120 --sensor.height 90 --evaluation.surface_samples 2000 ";
    EXPECT_EQ(nextview("scan slotted_plate " + small + quick + "--out " + in("scan")).exit_code, 0);
    return in("scan");
  }

  TemporaryFolder folder_;
};

TEST_F(RecordedScan, ReplayedInItsOrderGivesItsFiles) {
  const std::string scan = scan_of_a_plate();
  const Result run = nextview("scan --recorded " + scan + " --gain fixed-order " + quick + "--out " + in("replay"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("scan: 4 recorded frames"), HasSubstr("planned   recorded   random")));
  for (const char* file : {"map.ot", "map.bt", "cloud.ply"})
    EXPECT_EQ(read_file(scan + "/" + file), read_file(in("replay") + "/" + file)) << file;
  EXPECT_THAT(read_file(in("replay") + "/orders.csv"), HasSubstr("\n1,0,step 1,"));
  // And what was made of a recording can be refined, and gone through again.
  EXPECT_EQ(nextview("refine " + in("replay") + " --no-pictures --out " + in("refined")).exit_code, 0);
  const Result again = nextview("scan " + in("replay") + " --gain fixed-order " + quick + "--out " + in("again"));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_file(scan + "/map.ot"), read_file(in("again") + "/map.ot"));
}

TEST_F(RecordedScan, IsComparedWithATruthThatIsFound) {
  const Result run = nextview("scan --recorded " + scan_of_a_plate() + " --truth slotted_plate --start 2 " + quick +
                              "--out " + in("out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("of its points lie on slotted_plate.ply"));
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
  ASSERT_EQ(nextview(small + "--map.start " + scan + "/map.ot " + quick + "--out " + in("more")).exit_code, 0);
  EXPECT_GE(fs::file_size(in("more") + "/map.ot"), fs::file_size(scan + "/map.ot") / 2);
  const Result alone = nextview("scan " + scan + "/map.ot " + quick + "--out " + in("alone"));
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, HasSubstr("a map alone"));
}

TEST_F(RecordedScan, RealRangeImagesAreGoneThroughByAnyPlanner) {
  const fs::path bunny = fs::path(NEXTVIEW_SHARED_DIR) / "data/scans/stanford_bunny";
  if (!fs::exists(bunny)) GTEST_SKIP() << "an addition: " << bunny << " is not there";
  for (const char* gain : {"new-surface", "occlusion-aware", "random"}) {
    const Result run =
        nextview("scan --recorded " + bunny.string() + " --gain " + gain + " " + quick + "--out " + in(gain));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("Finished: 10 views taken."));
  }
}

}  // namespace
}  // namespace nextview
