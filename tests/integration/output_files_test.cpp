// Where results go: what is not a regular file is written to and not replaced, and what did not arrive is told.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class OutputFiles : public ::testing::Test {
 protected:
  fs::path in(const std::string& name) const { return folder_.path() / name; }
  /// Of two views.
  std::string scene() const {
    const std::string text =
        "param resolution_m 0.1\nscan 0 0 0 0 0 0 1 1\n0 0 0.3\nview 0 0 0 0 0 0 1\nview 0.1 0 0 0 0 0 1\n";
    std::ofstream(in("scene.txt")) << text;
    return in("scene.txt").string();
  }
  std::string score() const { return "score --gain occlusion-aware --scene " + scene(); }
  static std::string quick_scan(const fs::path& out) {
    return "scan box --views 2 --sensor.width 80 --sensor.height 60 --map.resolution 0.04 --out " + out.string();
  }
  /// Runs it with what stands behind the arguments in a shell, and expects one line on standard error.
  void expect_failure(const std::string& arguments, const std::string& redirection, const std::string& words) {
    const Result run = nextview_behind(fmt::format(R"(sh -c '"$0" "$@" {}')", redirection), arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }

  TemporaryFolder folder_;
};

TEST_F(OutputFiles, WhatCannotBePrintedIsAFailure) {
  for (const char* arguments :
       {"--help", "--version", "scan --help", "window --list-commands", "posterior --problem list"})
    expect_failure(arguments, ">/dev/full", "standard output: cannot be written: No space left on device");
  expect_failure(score(), ">/dev/full", "standard output: cannot be written: No space left on device");
  expect_failure(score() + " --csv -", ">/dev/full", "standard output: cannot be written: No space left on device");
  expect_failure(score(), ">&-", "standard output: cannot be written: Bad file descriptor");
}

TEST_F(OutputFiles, AScanWritesItsFilesAlsoIfItCannotPrint) {
  for (const char* redirection : {">/dev/full", ">&-"}) {
    expect_failure(quick_scan(in("out")) + " --no-pictures", redirection, "standard output: cannot be written: ");
    EXPECT_TRUE(fs::exists(in("out/surfaces.json"))) << redirection;
    EXPECT_THAT(read_file(in("out/steps.csv")), ::testing::StartsWith("step,")) << redirection;
    fs::remove_all(in("out"));
  }
}

TEST_F(OutputFiles, AFullDeviceStaysAndIsReported) {
  fs::create_symlink("/dev/full", in("full"));  // through a link: who replaces the device itself breaks the machine
  expect_failure(score() + " --csv " + in("full").string(), "",
                 in("full").string() + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file(in("full")));
}

TEST_F(OutputFiles, APipeIsWrittenToAndStays) {
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  const std::string wanted = nextview(score() + " --csv -").out;
  const Result run = nextview_behind(
      fmt::format(R"(sh -c 'timeout 60 cat "{0}/pipe" > "{0}/got" & "$0" "$@"; code=$?; wait; exit $code')",
                  folder_.path().string()),
      score() + " --csv " + in("pipe").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
  const auto head = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  EXPECT_EQ(head(read_file(in("got"))), head(wanted));
  EXPECT_EQ(std::count(wanted.begin(), wanted.end(), '\n'), 3);
}

TEST_F(OutputFiles, StandardOutputHasAName) {
  fs::create_symlink("/proc/self/fd/1", in("stdout"));  // as /dev/stdout is; see AFullDeviceStaysAndIsReported
  const Result run = nextview(score() + " --csv " + in("stdout").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, ::testing::StartsWith("view,occlusion-aware,rays,milliseconds\n0,"));
  EXPECT_TRUE(fs::is_symlink(in("stdout")));
}

TEST_F(OutputFiles, LinksStayAndWhatLiesBesideThePicturesToo) {
  ASSERT_EQ(nextview(quick_scan(in("out")) + " --no-pictures").exit_code, 0);
  fs::remove(in("out/steps.csv"));
  for (const char* name : {"step_01.png", "step_01.png.part", "steps.csv"}) {
    std::ofstream(in("behind_" + std::string(name))) << "victim";
    fs::create_symlink(in("behind_" + std::string(name)), in("out") / name);
  }
  const Result run = nextview(quick_scan(in("out")) + " --overwrite");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(read_file(in("behind_step_01.png")), "victim") << "links are followed";
  EXPECT_EQ(read_file(in("behind_step_01.png.part")), "victim");
  EXPECT_TRUE(fs::is_symlink(in("out/step_01.png.part")));
  EXPECT_FALSE(fs::exists(in("out/.part")));
}

TEST_F(OutputFiles, AFileThatGrowsTooLargeIsAnErrorAndLosesNothing) {
  const fs::path out = in("out");
  const Result run = nextview_behind(R"(sh -c 'ulimit -f 8; exec "$0" "$@"')",  // blocks of 512 bytes
                                     "scan box --views 2 --no-pictures --map.resolution 0.02 --out " + out.string());
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr(": cannot be written: File too large\n"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const auto& entry : fs::directory_iterator(out)) EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST_F(OutputFiles, PermissionsStay) {
  std::ofstream(in("scores.csv")) << "older";
  ::chmod(in("scores.csv").c_str(), 0600);
  EXPECT_EQ(nextview(score() + " --csv " + in("scores.csv").string()).exit_code, 0);
  struct stat status {};
  ASSERT_EQ(::stat(in("scores.csv").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_THAT(read_file(in("scores.csv")), ::testing::StartsWith("view,"));
}

}  // namespace
}  // namespace nextview
