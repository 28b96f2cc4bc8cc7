// An object that is a cloud, scanned from cameras that are projection matrices, as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/unit/session/made_projections.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string scan_of_cloud =
    "--views 3 --sensor.width 120 --sensor.height 90 --evaluation.surface_samples 2000 --no-pictures --no-surfaces ";

TEST(CloudObject, IsScannedFromProjectionMatricesAndThatIsSaid) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.path() / "stl006_total.ply", views = folder.path() / "cal18",
                 out = folder.path() / "out";
  made_projections::write_cloud(cloud, 20'000, 0.1);
  made_projections::write_cameras(views);
  const Result run = nextview("scan " + cloud.string() + " --views.layout file --views.file " + views.string() + " " +
                              scan_of_cloud + "--out " + out.string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("(its unit taken as mm)"),
                             HasSubstr("the object is a cloud of 20000 points: the program's own surface of it is"),
                             HasSubstr("1 file without a projection matrix passed over: readme.txt"),
                             HasSubstr("12 candidate views")));
  const std::string again = (folder.path() / "again").string();
  ASSERT_EQ(nextview("scan --config " + (out / "config.toml").string() + " --no-pictures --no-surfaces --out " + again)
                .exit_code,
            0);
  EXPECT_EQ(read_file(fs::path(again) / "views.csv"), read_file(out / "views.csv"));
  EXPECT_EQ(
      nextview("refine " + out.string() + " --gibbs.sweeps 4 --no-pictures --no-surfaces --out " + again + "-refined")
          .exit_code,
      0);
}

TEST(CloudObject, WhatIsWrongIsOneLine) {
  const TemporaryFolder folder;
  const fs::path views = folder.path() / "cal18", empty = folder.path() / "empty";
  made_projections::write_cameras(views);
  fs::create_directories(empty);
  write_file(views / "pos_002.txt", "1 0 0 0\n0 1 0 0\n");
  write_file(folder.path() / "few.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n0 0 0\n");
  const auto expect = [&](const std::string& arguments, const char* words) {
    const Result run =
        nextview("scan " + arguments + " " + scan_of_cloud + "--out " + (folder.path() / "out").string());
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, HasSubstr(words));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
  };
  expect((folder.path() / "few.ply").string(), "few.ply: is a cloud of 1 point, and no surface can be made of it");
  expect("box --views.layout file --views.file " + views.string(), "pos_002.txt:1: a 3 x 4 projection matrix has");
  expect("box --views.layout file --views.file " + empty.string(), "none of its 0 files holds a 3 x 4 projection");
}

}  // namespace
}  // namespace nextview
