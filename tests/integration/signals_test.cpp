// However it is asked to end, it keeps what it has, and ends.
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

class Signals : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string scan(int views) const {
    return fmt::format(
        "scan box --views {} --views.count 2000 --gain fixed-order --evaluation.enabled false --no-pictures "
        "--no-surfaces --sensor.width 80 --sensor.height 60 --map.resolution 0.04 --out {}",
        views, in("out"));
  }
  /// Runs it with these signals as a shell at a terminal has them (or `ignored`), waits until `condition` holds, and
  /// then does what `signals` say with the process $nextview. What never ends is killed: 137.
  Result signalled(const std::string& arguments, const std::string& condition, const std::string& signals,
                   const std::string& handling = "--default-signal=INT,TERM,HUP") const {
    return nextview_behind(
        fmt::format(R"(sh -c 'timeout --foreground --preserve-status --signal=KILL 90 env {0} "$0" "$@" > "{1}" & )"
                    R"(nextview=$!; for i in $(seq 600); do {2} && break; sleep 0.1; done; {3}; wait $nextview')",
                    handling, in("printed"), condition, signals),
        arguments);
  }
  std::string first_view_is_taken() const { return fmt::format("grep -q start \"{}\"", in("printed")); }

  TemporaryFolder folder_;
};

TEST_F(Signals, AScanThatIsStoppedKeepsItsViews) {
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const Result run = signalled(scan(2000), first_view_is_taken(), fmt::format("kill -{} $nextview", signal));
    EXPECT_EQ(run.exit_code, 130) << signal << run.err;
    ASSERT_TRUE(fs::exists(in("out/steps.csv"))) << signal << run.err;
    const std::string steps = read_file(in("out/steps.csv"));
    EXPECT_GT(std::count(steps.begin(), steps.end(), '\n'), 1) << signal;
    EXPECT_THAT(read_file(in("printed")), HasSubstr("Stopped by the user")) << signal;
    fs::remove_all(in("out"));
    fs::remove(in("printed"));
  }
}

TEST_F(Signals, AScanThatIsStoppedSaysThatItHasNoSurfaces) {
  std::string arguments = scan(2000);
  arguments.replace(arguments.find(" --no-surfaces"), std::string(" --no-surfaces").size(), "");
  const Result run = signalled(arguments, first_view_is_taken(), "kill -INT $nextview");
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_THAT(read_file(in("printed")), HasSubstr("(no surfaces: stopped before they were made"));
}

TEST_F(Signals, WhatIsIgnoredStaysIgnored) {
  const Result run = signalled(scan(40), first_view_is_taken(), "kill -HUP $nextview", "--ignore-signal=HUP");  // nohup
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(Signals, WhatHasNothingToKeepEndsWithTheSameCode) {
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);  // nobody reads from it: writing to it does not end
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const Result run = signalled("posterior --problem slot --sweeps 4 --csv " + in("pipe"), "sleep 3",
                                 fmt::format("kill -{} $nextview", signal));
    EXPECT_EQ(run.exit_code, 130) << signal;
    EXPECT_EQ(run.err, "nextview: stopped\n") << signal;
  }
}

// `nextview scan … | head -3`
TEST_F(Signals, AScanWhoseOutputNobodyReadsGoesOnToItsEnd) {
  const std::string unread = "bash -c 'set -o pipefail; \"$0\" \"$@\" 2>&1 | head -1'";
  const Result run = nextview_behind(unread, scan(8));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << run.out;
  EXPECT_EQ(run.err, "");
  const std::string steps = read_file(in("out/steps.csv"));
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 9);
  EXPECT_EQ(nextview("scan --no-pictures --no-surfaces --resume " + in("out")).exit_code, 0);  // its session is whole
}

TEST_F(Signals, ATableThatNobodyReadsToItsEndEndsQuietly) {
  std::ofstream scene(in("scene.txt"));
  scene << "scan 0 0 0 0 0 0 1 1\n0 0 0.3\n";
  for (int view = 0; view < 40'000; ++view) scene << "view 0 0 0 0 0 0 1\n";  // more than is held back
  scene.close();
  const Result run = nextview_behind("bash -c 'set -o pipefail; \"$0\" \"$@\" | head -1'",
                                     "score --gain unobserved-voxel --csv - --scene " + in("scene.txt"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
}

// To stop in good order it would have to wait until somebody reads from the pipe.
TEST_F(Signals, ASecondOneEndsAtOnce) {
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  std::ofstream(in("scene.txt")) << "scan 0 0 0 0 0 0 1 1\n0 0 0.3\nview 0 0 0 0 0 0 1\n";
  const Result run = signalled("score --gain occlusion-aware --scene " + in("scene.txt") + " --csv " + in("pipe"),
                               "sleep 3", "kill -TERM $nextview; sleep 0.5; kill -TERM $nextview 2>&-");
  EXPECT_EQ(run.exit_code, 130);
  EXPECT_EQ(run.err, "nextview: stopped\n");
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
}

}  // namespace
}  // namespace nextview
