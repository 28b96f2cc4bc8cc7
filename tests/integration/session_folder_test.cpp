// Sessions as folders, as a user has them: going on after whatever ended a scan, replacing, opening from anywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <random>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string small_camera = "--sensor.width 60 --sensor.height 45 ";
const std::string short_session =
    "--views.count 6 --map.resolution 0.04 --map.region_edge 0.8 --evaluation.surface_samples 200 --no-pictures "
    "--no-surfaces ";

class SessionFolders : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  /// Of every file below a folder what it holds, by its name; seconds aside.
  std::map<std::string, std::string> contents(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(in(name)))
      if (entry.is_regular_file() && entry.path().filename() != "timings.csv")
        all[fs::relative(entry.path(), in(name)).string()] = read_file(entry.path());
    return all;
  }
  /// But for the journal, which tells how it came about, and the order in which the list of files grew.
  void expect_same(const std::string& a, const std::string& b) const {
    const auto is = contents(a), was = contents(b);
    for (const auto& [name, bytes] : was)
      if (name != "journal" && name != "manifest.json") {
        ASSERT_TRUE(is.contains(name)) << name;
        EXPECT_EQ(is.at(name) == bytes, true) << name << " differs";
      }
    EXPECT_EQ(is.size(), was.size());
  }
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const Result run = nextview(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  /// The program, killed at its N-th change of a file below `folder`; 0: never. Returns how many there were.
  long run_and_kill(long at, const std::string& folder, const std::string& arguments) const {
    const std::string count = in("count");
    fs::remove(count);
    const Result run = nextview_behind("LD_PRELOAD=" NEXTVIEW_KILL_AT_CALL " NEXTVIEW_KILL_BELOW=" + folder +
                                           " NEXTVIEW_KILL_COUNT=" + count + " NEXTVIEW_KILL_AT=" + std::to_string(at),
                                       arguments);
    EXPECT_EQ(run.exit_code != 0, at > 0) << "killed at " << at << "? " << run.err;
    return fs::exists(count) ? std::stol(read_file(count)) : 0;
  }
  TemporaryFolder folder_;
};

/// With the small_camera built in, and with the same one behind a driver.
class KilledSessions : public SessionFolders, public testing::WithParamInterface<bool> {
 protected:
  std::string source() const {
    return GetParam() ? "--driver '\"" NEXTVIEW_PROGRAM "\" driver simulated box " + small_camera + "' " : "";
  }
  std::string scan(const std::string& name) const {
    return "scan " + (GetParam() ? source() : "box " + small_camera) + "--views 3 " + short_session + "--out " +
           in(name);
  }
  std::string resumed() const { return "scan --resume " + in("killed") + " --no-pictures --no-surfaces " + source(); }
  /// What a user does after the scan into "killed" was ended, and that it comes to what a whole one gives.
  void goes_on_to_the_same() const {
    const bool has_begun = fs::exists(in("killed/journal")) && fs::file_size(in("killed/journal")) > 0;
    const std::string anew = scan("killed") + " --overwrite";
    const Result on = nextview(has_begun ? resumed() : anew);
    if (has_begun && on.exit_code != 0) {  // its first record was being written
      EXPECT_THAT(on.err, HasSubstr("its beginning is lost"));
      ASSERT_EQ(nextview(anew).exit_code, 0);
    }
    expect_same("killed", "whole");
  }
};

INSTANTIATE_TEST_SUITE_P(By, KilledSessions, testing::Bool(),
                         [](const auto& behind) { return behind.param ? "ADriver" : "TheBuiltInCamera"; });

/// At every write by NEXTVIEW_EVERY_WRITE=1, at some of them here.
TEST_P(KilledSessions, AtAnyWriteGoOnToTheSameBytes) {
  const long calls = run_and_kill(0, in("whole"), scan("whole"));
  ASSERT_GT(calls, 60);
  const long stride = std::getenv("NEXTVIEW_EVERY_WRITE") ? 1 : calls / (GetParam() ? 3 : 12);
  for (long at = 1; at <= calls; at += stride) {
    SCOPED_TRACE(at);
    fs::remove_all(in("killed"));
    run_and_kill(at, in("killed"), scan("killed"));
    goes_on_to_the_same();
  }
}

/// As often as NEXTVIEW_RANDOM_KILLS says; what goes on is killed, too.
TEST_P(KilledSessions, AtRandomMomentsGoOnToTheSameBytes) {
  const char* const wanted = std::getenv("NEXTVIEW_RANDOM_KILLS");
  const int rounds = wanted ? std::atoi(wanted) : 2;
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(nextview(scan("whole")).exit_code, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(1);
  const auto run_for_a_while = [&](const std::string& arguments) {
    const double share = std::uniform_real_distribution(0.0, 1.0)(random);
    nextview_behind("timeout -s KILL " + std::to_string(0.01 + share * whole.count()), arguments);
  };
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    fs::remove_all(in("killed"));
    run_for_a_while(scan("killed"));
    run_for_a_while(resumed());
    goes_on_to_the_same();
  }
}

/// At every write by NEXTVIEW_EVERY_WRITE=1, at some of them here. Where there is room again it goes on.
TEST_F(SessionFolders, AFullDiskAtAnyWriteIsSaidAndItGoesOnLater) {
  const std::string scan = "scan box --views 3 " + small_camera + short_session;
  const long calls = run_and_kill(0, in("whole"), scan + "--out " + in("whole"));
  ASSERT_GT(calls, 60);
  const long stride = std::getenv("NEXTVIEW_EVERY_WRITE") ? 1 : calls / 10;
  for (long at = 1; at <= calls; at += stride) {
    SCOPED_TRACE(at);
    fs::remove_all(in("full"));
    const Result full = nextview_behind("LD_PRELOAD=" NEXTVIEW_KILL_AT_CALL " NEXTVIEW_KILL_BELOW=" + in("full") +
                                            " NEXTVIEW_FULL_AT=" + std::to_string(at),
                                        scan + "--out " + in("full"));
    EXPECT_EQ(full.exit_code, 2);
    EXPECT_THAT(full.err, HasSubstr(in("full")));
    EXPECT_THAT(full.err, HasSubstr("No space left on device"));
    EXPECT_EQ(std::ranges::count(full.err, '\n'), 1) << full.err;
    const bool has_begun = fs::exists(in("full/journal")) && fs::file_size(in("full/journal")) > 0;
    const Result on = has_begun ? nextview("scan --resume " + in("full") + " --no-pictures --no-surfaces")
                                : nextview(scan + "--overwrite --out " + in("full"));
    EXPECT_EQ(on.exit_code, 0) << on.err;
    expect_same("full", "whole");
  }
}

TEST_F(SessionFolders, IsReplacedOnlyIfOneSaysSo) {
  const std::string scan = "scan box --views 1 " + small_camera + short_session + "--out " + in("out");
  ASSERT_EQ(nextview(scan).exit_code, 0);
  write_file(in("out/note.txt"), "mine");
  expect_refused(scan, "holds a session: --resume goes on with it, --overwrite replaces it");
  ASSERT_EQ(nextview(scan + " --overwrite").exit_code, 0);
  EXPECT_EQ(read_file(in("out/note.txt")), "mine");
  fs::create_directories(in("mine"));
  write_file(in("mine/note.txt"), "mine");
  expect_refused("scan box --overwrite --views 1 " + small_camera + short_session + "--out " + in("mine"),
                 "holds no session");
}

TEST_F(SessionFolders, GoesOnBeyondItsEndWithAnotherOne) {
  const std::string scan = "scan box " + small_camera + short_session;
  ASSERT_EQ(nextview(scan + "--views 2 --out " + in("two")).exit_code, 0);
  ASSERT_EQ(nextview(scan + "--views 4 --out " + in("four")).exit_code, 0);
  const Result on = nextview("scan --resume " + in("two") + " --views 4 --no-pictures --no-surfaces");
  ASSERT_EQ(on.exit_code, 0) << on.err;
  EXPECT_THAT(on.out, testing::HasSubstr("\nstep  view "));
  EXPECT_THAT(on.out, testing::Not(HasSubstr("It was finished already")));
  expect_same("two", "four");
}

TEST_F(SessionFolders, AFinishedOneGetsWhatIsMissing) {
  ASSERT_EQ(nextview("scan box --views 2 " + small_camera + short_session + "--out " + in("whole")).exit_code, 0);
  fs::copy(in("whole"), in("part"), fs::copy_options::recursive);
  for (const char* name :
       {"map.ot", "cloud.ply", "steps.csv", "views.csv", "metrics.json", "config.toml", "manifest.json"})
    fs::remove(in("part") + "/" + name);
  const Result again = nextview("scan --resume " + in("part") + " --no-pictures --no-surfaces");
  ASSERT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("It was finished already: no view is taken"));
  expect_same("part", "whole");
}

TEST_F(SessionFolders, AFinishedOneThatIsWholeIsNotGoneThroughAgain) {
  ASSERT_EQ(nextview("scan box --views 2 " + small_camera + short_session + "--out " + in("out")).exit_code, 0);
  const auto before = fs::last_write_time(in("out/map.ot"));
  const std::string again = "scan --resume " + in("out") + " --no-pictures --no-surfaces";
  const Result nothing = nextview(again);
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_THAT(nothing.out, HasSubstr("no view is taken, its files are there"));
  EXPECT_EQ(fs::last_write_time(in("out/map.ot")), before);
  fs::remove(in("out/views.csv"));
  EXPECT_THAT(nextview(again).out, HasSubstr("its files are made again"));
  EXPECT_TRUE(fs::exists(in("out/views.csv")));
  EXPECT_THAT(nextview("scan --resume " + in("out") + " --no-surfaces").out, HasSubstr("its files are made again"));
  EXPECT_TRUE(fs::exists(in("out/step_01.png"))) << "it had been made without pictures";
}

TEST_F(SessionFolders, AFinishedOneThatLostACaptureKeepsItsResults) {
  ASSERT_EQ(nextview("scan box --views 3 " + small_camera + short_session + "--out " + in("out")).exit_code, 0);
  for (const char* damaged : {"out/state", "out/scans/0002.npy"}) {
    std::string bytes = read_file(in(damaged));
    bytes[bytes.size() / 2] ^= 1;
    write_file(in(damaged), bytes);
  }
  const auto before = contents("out");
  const std::string again = "scan --resume " + in("out") + " --no-pictures --no-surfaces";
  expect_refused(again, "scans/0002.npy: is not what was captured: it is damaged, or was changed; the scan had ended");
  EXPECT_EQ(contents("out"), before);
  const Result on = nextview(again + " --views 4");
  EXPECT_EQ(on.exit_code, 0);
  EXPECT_THAT(on.err, HasSubstr("a view is left out"));
}

TEST_F(SessionFolders, MayNotEndEarlierThanItHas) {
  ASSERT_EQ(
      nextview("scan box --views 3 --termination.surface_left 0 " + small_camera + short_session + "--out " + in("out"))
          .exit_code,
      0);
  const std::string before = read_file(in("out/config.toml"));
  expect_refused("scan --resume " + in("out") + " --no-pictures --termination.surface_left 1",
                 "out: by these settings it would have ended after 1 of its 3 views: no view is worth it");
  EXPECT_EQ(read_file(in("out/config.toml")), before);
}

TEST_F(SessionFolders, MayBeMovedWithTheObjectThatLiesInside) {
  fs::create_directories(in("a"));
  ASSERT_EQ(nextview("scan box --views 2 " + small_camera + short_session + "--out " + in("a/out")).exit_code, 0);
  fs::rename(in("a"), in("b"));
  EXPECT_EQ(nextview("scan --resume " + in("b/out") + " --views 3 --no-pictures --no-surfaces").exit_code, 0);
  fs::remove(in("b/out/views.csv"));
  EXPECT_EQ(nextview("refine " + in("b/out") + " --gibbs.sweeps 40 --no-pictures --no-surfaces --out " + in("refined"))
                .exit_code,
            0);
}

TEST_F(SessionFolders, ThatTheWindowKeepsAreKnownByTheirNamesAlone) {
  const std::string name = "'2026-01-31 23.59.59 box'", state = in("state");
  fs::create_directories(state + "/nextview");
  ASSERT_EQ(
      nextview("scan box --views 1 " + short_session + small_camera + "--out " + state + "/nextview/" + name).exit_code,
      0);
  const auto run = [&](const std::string& arguments) {
    return nextview_behind("env XDG_STATE_HOME=" + state, arguments);
  };
  for (const std::string& arguments : {"info " + name, "scan --no-pictures --no-surfaces --resume " + name,
                                       "score " + name, "export " + name + " views " + in("views.csv")}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << result.err;
  }
  for (const std::string& window : {"window " + name, name})
    EXPECT_THAT(run(window + " --gain random").err, HasSubstr("box: a session goes on with its own settings"));
  expect_refused("info " + name, "there is no such file");
}

TEST_F(SessionFolders, AnObjectThatIsGoneIsToBePutBack) {
  fs::copy(NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply", in("part.ply"));
  ASSERT_EQ(nextview("scan " + in("part.ply") + " --views 1 " + small_camera + short_session + "--out " + in("out"))
                .exit_code,
            0);
  fs::remove(in("part.ply"));
  expect_refused("scan --resume " + in("out"),
                 "part.ply: is not there, and " + in("out") + " was scanned of it; put it back");
}

TEST_F(SessionFolders, OfOneWithoutAJournalNoCaptureIsWrittenOver) {
  ASSERT_EQ(nextview("scan box --views 2 " + small_camera + short_session + "--out " + in("out")).exit_code, 0);
  fs::remove(in("out/journal"));
  const std::string capture = read_file(in("out/scans/0002.npy"));
  expect_refused("scan --resume " + in("out"),
                 "out: its journal is gone, which says what its scans are; scan them anew");
  EXPECT_EQ(read_file(in("out/scans/0002.npy")), capture);
}

/// A robot that is 30 mm off: check rejects its scans, three others are tried, and the views that were taken are kept.
TEST_F(SessionFolders, RejectedScansAreFollowedByOtherViewsAndThenByTheEnd) {
  const std::string off = "--robot.position_error 0.03 --registration.mode check --registration.min_overlap 0.05 ";
  const Result run =
      nextview("scan slotted_housing --views 6 --views.layout rings --views.rings 1 --gain random " + off +
               "--sensor.width 160 --sensor.height 120 --evaluation.enabled false --no-pictures "
               "--no-surfaces --out " +
               in("out"));
  EXPECT_EQ(run.exit_code, 2) << run.err;
  std::size_t rejected = 0;
  for (std::size_t at = run.err.find("the scan is rejected"); at != run.err.npos;
       at = run.err.find("the scan is rejected", at + 1))
    ++rejected;
  EXPECT_GE(rejected, 4u) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Not finished: the scan is rejected: the scan lies "));
  EXPECT_EQ(nextview("scan --resume " + in("out") + " --registration.beyond_limits accept --no-pictures --no-surfaces")
                .exit_code,
            0);
}

TEST_F(SessionFolders, MistakesAreOneLine) {
  ASSERT_EQ(nextview("scan box --views 1 " + small_camera + short_session + "--out " + in("out")).exit_code, 0);
  expect_refused("scan --resume " + in("nothing"), "nothing: there is no such folder; give the folder of a session");
  expect_refused("scan --resume " + in("out/journal"), "out/journal: is a file; give the folder of a session");
  expect_refused("scan --resume " + in("out/scans"), "out/scans: holds no session; give");
  expect_refused("scan --resume " + in("out") + " --planner.gain random",
                 "termination.* and the limits of registration alone may change");
  expect_refused("scan --resume " + in("out") + " --out " + in("other"), "--out");
  ASSERT_EQ(nextview("scan box --views 2 " + small_camera + short_session + "--out " + in("two")).exit_code, 0);
  const std::string before = read_file(in("two/config.toml"));
  expect_refused("scan --resume " + in("two") + " --views 1", "two has 2 views already; give more to go on");
  EXPECT_EQ(read_file(in("two/config.toml")), before);
  write_file(in("out/journal"), "no journal\n");
  expect_refused("scan --resume " + in("out"), "journal: is no journal of a session");
}

}  // namespace
}  // namespace nextview
