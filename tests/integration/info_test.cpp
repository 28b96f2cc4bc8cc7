// What a file holds, and a part at its own size, as a user finds out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/cloud/point_cloud.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const std::string quick_scan =
    "--views 3 --sensor.width 120 --sensor.height 90 --views.count 12 --evaluation.surface_samples 2000 --no-pictures "
    "--no-surfaces ";

/// A box of half a metre, at another size or in another unit.
fs::path scaled_box(const fs::path& folder, double factor) {
  std::string text = "OFF\n8 12 0\n";
  for (int c = 0; c < 8; ++c)
    text += std::to_string(factor * (c & 1 ? 0.5 : 0.0)) + " " + std::to_string(factor * (c & 2 ? 0.3 : 0.0)) + " " +
            std::to_string(factor * (c & 4 ? 0.1 : 0.0)) + "\n";
  text +=
      "3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";
  write_file(folder / "part.off", text);
  return folder / "part.off";
}

TEST(Info, TellsWhatFilesHold) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), part = scaled_box(folder.path(), 183.0).string();
  ASSERT_EQ(nextview("scan slotted_plate " + quick_scan + "--out " + out).exit_code, 0);
  const Result run = nextview("info slotted_plate " + part + " " + out + " " + out + "/cloud.ply " + out + "/map.ot " +
                              out + "/config.toml");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("slotted_plate: a mesh of "), HasSubstr("taken as m (")));
  EXPECT_THAT(run.out, AllOf(HasSubstr("91.5 x 54.9 x 18.3 mm"), HasSubstr("taken as mm")));
  EXPECT_THAT(run.out, HasSubstr("results of `nextview scan`"));
  EXPECT_THAT(run.out, HasSubstr("slotted_plate.ply: closed\n  branch 'main': "));
  EXPECT_THAT(run.out, HasSubstr("of visible surface"));
  EXPECT_THAT(run.out, HasSubstr(", unmeasured entropy ")) << "the entropy that scan prints";
  EXPECT_THAT(run.out, HasSubstr("cloud.ply: a cloud of "));
  EXPECT_THAT(run.out, HasSubstr("map.ot: an occupancy map (OctoMap): "));
  EXPECT_THAT(run.out, AllOf(HasSubstr("a configuration that gives"), HasSubstr("map.resolution = 0.01")));
  EXPECT_EQ(run.err, "");
}

TEST(Info, TellsViewsAndStudies) {
  const TemporaryFolder folder;
  const std::string views = (folder.path() / "views.txt").string(), study = (folder.path() / "study.toml").string();
  write_file(views, "# poses\n0 0 0 0 0 0 1\n1 2 0 0 0 0 1\n");
  write_file(study,
             "name = \"s\"\n[[planning]]\nobjects = [\"box\"]\npolicies = [\"random\"]\nseeds = [1, 2]\nviews = 2\n");
  const Result run = nextview("info " + views + " " + study);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, AllOf(HasSubstr("candidate views: 2 views\n  1 x 2 x 0 m"), HasSubstr("a study of 2 runs")));
  write_file(study, "# no [[planning]]\nseed = 3\n");
  EXPECT_THAT(nextview("info " + study).out, HasSubstr("a configuration that gives 1 setting"));
}

TEST(Info, TellsDemos) {
  const TemporaryFolder folder;
  const std::string good = (folder.path() / "mine.nextview").string(), bad = (folder.path() / "bad.nextview").string();
  write_file(good, "open gearbox\nstep\nexport-cloud cloud.ply\n");
  write_file(bad, "stap\n");
  EXPECT_THAT(nextview("info " + good).out, HasSubstr("a demo of 3 commands: nextview demo "));
  const Result run = nextview("info " + bad);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("bad.nextview:1: there is no command 'stap'"));
}

TEST(Info, TellsTablesReportsAndJournals) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  ASSERT_EQ(
      nextview("scan box --views 2 --sensor.width 40 --sensor.height 30 --map.resolution 0.04 --no-pictures --out " +
               out.string())
          .exit_code,
      0);
  const auto told = [&](const std::string& name) {
    const Result run = nextview("info " + (out / name).string());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  EXPECT_THAT(told("steps.csv"), AllOf(HasSubstr("steps.csv: the steps of a scan: 2 steps\n"),
                                       HasSubstr("\n  path[m] after the last: "), HasSubstr("\n  coverage_visible@")));
  EXPECT_THAT(told("scores.csv"), HasSubstr("the candidates of a scan after each view: 96 rows\n"));
  EXPECT_THAT(told("views.csv"), HasSubstr("poses of the camera in the world: 2 views\n"));
  EXPECT_THAT(told("timings.csv"), HasSubstr("the seconds that each step of a scan took: 2 steps\n"));
  EXPECT_THAT(told("metrics.json"), AllOf(HasSubstr("metrics.json: what a scan reached\n  object: box.ply\n"),
                                          HasSubstr("\n  views: 2\n"), HasSubstr("\n  coverage: d_reg_m: ")));
  EXPECT_THAT(told("manifest.json"), HasSubstr("\n  command: scan\n"));
  EXPECT_THAT(told("surfaces.json"), HasSubstr("the surfaces that were made of a scan\n  surface_map: "));
  EXPECT_THAT(told("journal"), AllOf(HasSubstr("the journal of a session\n  a session of "), HasSubstr(": 2 views")));
  EXPECT_THAT(told("scans/"), AllOf(HasSubstr("the captures of a session: 2 files\n"), HasSubstr(": 2 views")));
  EXPECT_THAT(told("scans/0001.npy"), AllOf(HasSubstr("a session's capture of 40 x 30 pixels: "),
                                            HasSubstr(" measured, from "), HasSubstr(" m, ")));
  EXPECT_THAT(told("state"), HasSubstr("what was computed of a session"));
  fs::copy(out / "scans/0001.npy", out / "depth.npy");
  EXPECT_THAT(told("depth.npy"), AllOf(HasSubstr("a depth image of 40 x 30 pixels: "), HasSubstr("dataset.toml")));
  write_file(out / "other.csv", "time,voltage\n1,2\n");
  EXPECT_THAT(nextview("info " + (out / "other.csv").string()).err,
              HasSubstr("other.csv: is no table or report that Nextview writes"));
}

TEST(Info, DescribesRecordedDataAndWritesItDownOnce) {
  const TemporaryFolder folder;
  const fs::path scans = folder.path() / "scans", unknown = folder.path() / "unknown";
  fs::create_directories(scans);
  fs::create_directories(unknown);
  write_file(scans / "a.ply",
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n0 0 1\n0.5 0 1\n");
  write_file(scans / "poses.txt", "0 0 0 0 0 0 1\n");
  write_file(folder.path() / "a.log", "NODE 0 0 0 0 0 0\n1 0 0\n");
  const std::string scans_text = scans.string(), log = (folder.path() / "a.log").string();
  EXPECT_THAT(
      nextview("info " + scans_text + " " + log).out,
      AllOf(HasSubstr("recorded data (clouds): 1 frame with 2 points"), HasSubstr("clouds, placed by poses.txt"),
            HasSubstr("recorded data (scan-graph): 1 frame with 1 point\n")));
  ASSERT_EQ(nextview("info --write-dataset " + scans_text).exit_code, 0);
  EXPECT_THAT(read_file(scans / "dataset.toml"), HasSubstr("poses_format = 'quaternion_xyzw'"));
  EXPECT_THAT(nextview("info " + scans_text + "/dataset.toml").out, Not(HasSubstr("placed by")));
  const Result again = nextview("info --write-dataset " + scans_text);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("is there already"));
  EXPECT_THAT(nextview("info " + unknown.string() + " --write-dataset").out, HasSubstr("as a template"));
  EXPECT_EQ(nextview("info " + unknown.string()).exit_code, 2);
}

TEST(Info, ADescriptionThatWasGuessedWronglyIsToBeCorrected) {
  const TemporaryFolder folder;
  const fs::path scans = folder.path() / "scans";
  fs::create_directories(scans);
  write_file(scans / "a.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n0 0 1\n");
  write_file(scans / "notes.txt", "of no frame\n");
  EXPECT_EQ(nextview("info " + scans.string()).exit_code, 2);
  const Result run = nextview("info " + scans.string() + " --write-dataset");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("dataset.toml is written, and is to be corrected: "));
  EXPECT_TRUE(fs::exists(scans / "dataset.toml"));
}

TEST(Info, ASessionNeedsNoDescription) {
  const TemporaryFolder folder;
  const std::string session = (folder.path() / "out").string();
  ASSERT_EQ(nextview("scan box --views 1 --sensor.width 40 --sensor.height 30 --map.resolution 0.04 --no-pictures "
                     "--no-surfaces --out " +
                     session)
                .exit_code,
            0);
  const Result run = nextview("info " + session + " --write-dataset");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("is a session, whose captures are read as they are"));
  EXPECT_FALSE(fs::exists(folder.path() / "out/dataset.toml"));
}

TEST(Info, CloudsAreTakenAsScanTakesThem) {
  const TemporaryFolder folder;
  const std::string points = "5 7 -9\n65 7 -9\n5 47 11\n";
  const fs::path ply = folder.path() / "a.ply", pcd = folder.path() / "b.pcd";
  write_file(ply,
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n" +
                 points);
  write_file(pcd,
             "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\n"
             "DATA ascii\n" +
                 points);
  for (const fs::path& file : {ply, pcd})
    EXPECT_THAT(nextview("info " + file.string()).out,
                AllOf(HasSubstr("a cloud of 3 points\n  60 x 40 x 20 mm"), HasSubstr("taken as mm")));
}

TEST(Info, DatasetTomlGoesBeforeWhatIsGuessed) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  write_file(folder.path() / "a.ply",
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n0 0 1\n0.5 0 1\n");
  write_file(folder.path() / "a.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  EXPECT_THAT(nextview("info " + in).out, AllOf(HasSubstr("range scans (Stanford): 1 scan"), HasSubstr("0.7 m off")));
  write_file(folder.path() / "dataset.toml",
             "format = 'clouds'\nframes = 'a.ply'\nposes = 'a.conf'\nposes_format = 'conf'\n");
  EXPECT_THAT(nextview("info " + in).out, HasSubstr("recorded data (clouds): 1 frame with 2 points"));
}

TEST(Info, WhatCannotBeReadIsALineAndTheRestIsTold) {
  const TemporaryFolder folder;
  const Result run =
      nextview("info " + (folder.path() / "none.stl").string() + " " + folder.path().string() + " sphere");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, HasSubstr("sphere: a mesh of "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("none.stl"), HasSubstr("is an empty folder")));
}

TEST(OwnSize, APartInMillimetresIsScannedAsLargeAsItIs) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const Result run =
      nextview("scan " + scaled_box(folder.path(), 183.00123).string() + " " + quick_scan + "--out " + out);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("at d_reg = 0.915 mm")) << "as in its second line, though it is 0.915006";
  EXPECT_THAT(run.out, AllOf(HasSubstr("91.5 x 54.9 x 18.3 mm (its unit taken as mm)"), HasSubstr("voxels 2 mm")));
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : read_ply(folder.path() / "out" / "cloud.ply")) box.extend(point);
  EXPECT_NEAR(box.sizes().maxCoeff(), 0.0915, 0.004);
  EXPECT_THAT(read_file(folder.path() / "out" / "config.toml", 1 << 20), HasSubstr("resolution = 0.002 "));
}

TEST(OwnSize, OfMetresThatNobodySaidIsDoubtedWhereItIsLarge) {
  const TemporaryFolder folder;
  const Result run = nextview("scan " + scaled_box(folder.path(), 16.0).string() + " " + quick_scan + "--out " +
                              (folder.path() / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("(no unit in the file: metres; --object.unit mm if it is millimetres)"));
}

/// The same shape at another size: the same scan, but for rounding.
TEST(OwnSize, CoverageIsThatOfTheSameShapeAtHalfAMetre) {
  const auto coverage = [](double factor) {
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string();
    const Result run =
        nextview("scan " + scaled_box(folder.path(), factor).string() + " " + quick_scan + "--out " + out);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::string steps = read_file(folder.path() / "out" / "steps.csv", 1 << 20);
    const std::string last = steps.substr(steps.rfind('\n', steps.size() - 2) + 1);
    std::string cell;
    std::istringstream cells(last);
    for (int i = 0; i <= 15; ++i) std::getline(cells, cell, ',');  // coverage@…mm
    return std::stod(cell);
  };
  const double at_half_a_metre = coverage(1.0);
  EXPECT_GT(at_half_a_metre, 0.3);
  for (const double factor : {24.0, 183.0, 4.0, 60000.0})  // 12 mm, 91.5 mm, 2 m, 30 m
    EXPECT_NEAR(coverage(factor), at_half_a_metre, 0.08) << factor;
}

}  // namespace
}  // namespace nextview
