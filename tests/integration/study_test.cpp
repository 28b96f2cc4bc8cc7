// Studies as a user runs them: shards, kills, broken objects, folders that hold something else.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* tiny = R"(
[settings]
object.longest_side = 0.5
sensor.width = 80
sensor.height = 60
map.resolution = 0.04
views.count = 8
planner.ray_columns = 8
planner.ray_rows = 6
evaluation.surface_samples = 500
gibbs.sweeps = 20
[[planning]]
objects = ["sphere", "broken.ply", "box"]
policies = ["new-surface", "random"]
seeds = [1, 2]
views = 3
[[maps]]
objects = ["box"]
maps = ["octomap", "gibbs"]
views = 3
)";

constexpr int some_failed = 2;  // of its runs, which the summary has

class StudyCommand : public testing::Test {
 protected:
  StudyCommand() {
    std::ofstream(file("study.toml")) << tiny;
    std::ofstream(file("broken.ply")) << "ply, or so it says\n";
  }
  fs::path file(const std::string& name) const { return folder_.path() / name; }
  std::string quoted(const std::string& name) const { return "'" + file(name).string() + "'"; }
  /// A shard as a task of a Slurm job array does it.
  Result array_task(int shard, int shards) const {
    const std::string task = fmt::format(
        "env SLURM_ARRAY_TASK_ID={} SLURM_CPUS_PER_TASK=2 sh -c "
        "'PATH=$(dirname \"$0\"):$PATH exec bash {}/assets/studies/slurm_array.sh \"$@\"'",
        shard, NEXTVIEW_SOURCE_DIR);
    return nextview_behind(task, fmt::format("{} {} {}", quoted("study.toml"), quoted("array"), shards));
  }
  Result study(const std::string& out, const std::string& more = "") const {
    return nextview(fmt::format("study {} --out {} {}", quoted("study.toml"), quoted(out), more));
  }
  /// All that is no time.
  std::map<std::string, std::string> content(const std::string& out) const {
    std::map<std::string, std::string> content;
    for (const auto& entry : fs::recursive_directory_iterator(file(out)))
      if (entry.is_regular_file() && entry.path().filename() != "timings.csv")
        content[entry.path().lexically_relative(file(out)).string()] = read_file(entry.path());
    return content;
  }
  TemporaryFolder folder_;
};

TEST_F(StudyCommand, ABrokenObjectIsReportedAndTheOthersGoOn) {
  const Result run = study("out");
  EXPECT_EQ(run.exit_code, some_failed) << run.err;
  EXPECT_THAT(run.err, HasSubstr("4 of 14 runs came to nothing"));
  const std::string csv = read_file(file("out") / "summary.csv");
  EXPECT_THAT(csv, HasSubstr("planning,1,broken,default,3,random,failure,0,2,,,,7-8,"));
  EXPECT_THAT(csv, HasSubstr("broken.ply"));
  EXPECT_THAT(csv, HasSubstr("planning,1,box,default,3,random,mean_coverage[%],0,2,"));
  EXPECT_THAT(csv, HasSubstr("planning,1,(mean),default,3,random,mean_coverage[%],0,2,"));  // of two objects
  const Result info = nextview("info " + quoted("out"));
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("the study 'study' of 14 runs, with its summary: nextview figure report --study"));
  EXPECT_THAT(info.out, HasSubstr("\n  box ("));
  const Result lacks = nextview(fmt::format("figure gap_closed --study {} --out {}", quoted("out"), quoted("figures")));
  EXPECT_EQ(lacks.exit_code, 2);
  EXPECT_THAT(lacks.err, HasSubstr("nothing that gap_closed shows, which needs the policies random and oracle"));
  const Result is_study = nextview(fmt::format("figure all {} --out {}", quoted("out"), quoted("figures")));
  EXPECT_EQ(is_study.exit_code, 2);
  EXPECT_THAT(is_study.err, HasSubstr("is the folder of a study, which is given as --study"));
}

TEST_F(StudyCommand, FiguresAreMadeForTheColumnOfAPaper) {
  const Result column = nextview("figure coverage_by_view --width 85 --dpi 300 --out " + quoted("column"));
  EXPECT_EQ(column.exit_code, 0) << column.err;
  EXPECT_EQ(column.err, "");
  EXPECT_THAT(read_file(file("column") / "coverage_by_view.svg"), HasSubstr("width=\"85mm\""));
  EXPECT_THAT(nextview("info " + quoted("column/coverage_by_view.png")).out, HasSubstr("a picture of 1004 x "));
  const Result narrow = nextview("figure log_loss_by_object --width 60 --out " + quoted("narrow"));
  EXPECT_EQ(narrow.exit_code, 0);
  EXPECT_THAT(narrow.err, testing::MatchesRegex(
                              "warning: log_loss_by_object: its smallest letters are [0-9.]+ pt at --width 60; from "
                              "[0-9]+ on they are 7 pt\n"));
  EXPECT_THAT(nextview("figure gap_closed --width 85 --size 800x600 --out " + quoted("both")).err,
              HasSubstr("--width"));
}

TEST_F(StudyCommand, IsTheSameOnAnyNumberOfThreadsAndHoweverSharded) {
  ASSERT_EQ(study("whole", "--threads 1").exit_code, some_failed);
  std::string folders;
  const std::map<int, std::string> failed = {{1, "7"}, {2, "5, 8"}, {3, "6"}};
  for (const int i : {2, 3, 1}) {
    const Result task = array_task(i, 3);
    ASSERT_EQ(task.exit_code, some_failed) << task.err;
    EXPECT_THAT(task.err, HasSubstr(fmt::format("came to nothing: {}\n", failed.at(i))));
    folders += quoted(fmt::format("array/shard-{}", i)) + " ";
  }
  const Result merged = nextview(fmt::format("study --merge {} --out {}", folders, quoted("merged")));
  ASSERT_EQ(merged.exit_code, some_failed) << merged.err;
  for (const char* name : {"summary.csv", "summary.json", "runs.csv", "study.toml", "keys"})
    EXPECT_EQ(read_file(file("merged") / name), read_file(file("whole") / name)) << name;
  const Result incomplete =
      nextview(fmt::format("study --merge {} --out {}", quoted("array/shard-1"), quoted("incomplete")));
  EXPECT_EQ(incomplete.exit_code, 2);
  EXPECT_THAT(
      incomplete.err,
      HasSubstr("array/shard-1: 9 of 14 runs are not done (2, 3, 5, 6, 8, …); --merge needs the folders of all"));
  const Result third = nextview(fmt::format("study --merge {} {} --out {}", quoted("array/shard-1"),
                                            quoted("array/shard-2"), quoted("incomplete")));
  EXPECT_THAT(third.err, HasSubstr("shard-2: 4 of 14 runs are not done in any of them (3, 6, 9, 12)"));
  EXPECT_FALSE(fs::exists(file("incomplete")));
}

/// NEXTVIEW_RANDOM_KILLS sets how many times a study is begun, killed until it is done, and compared; twenty were run.
TEST_F(StudyCommand, KilledAtAnyMomentItResumesToTheSameBytes) {
  const char* const wanted = std::getenv("NEXTVIEW_RANDOM_KILLS");
  const int rounds = wanted ? std::atoi(wanted) : 1;
  ASSERT_EQ(study("whole").exit_code, some_failed);
  std::mt19937 random(std::uint32_t(GTEST_FLAG_GET(random_seed)) + 18);
  int killed = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::string out = fmt::format("killed{}", round);
    for (int kill = 0; kill < 8; ++kill) {
      const double after = 0.05 + 0.4 * double(random() % 1000) / 1000.0;
      const Result run = nextview_behind(fmt::format("timeout --signal=KILL {:.3f}", after),
                                         fmt::format("study {} --resume --out {}", quoted("study.toml"), quoted(out)));
      killed += run.exit_code == 137;
      EXPECT_TRUE(run.exit_code == 137 || run.exit_code == some_failed) << run.err;
    }
    ASSERT_EQ(study(out, "--resume").exit_code, some_failed);
    EXPECT_EQ(content(out), content("whole"));
    const std::string timings = read_file(file(out) / "timings.csv");
    EXPECT_EQ(study(out, "--resume").exit_code, some_failed);  // nothing is left to do
    EXPECT_EQ(read_file(file(out) / "timings.csv"), timings);
    EXPECT_EQ(content(out), content("whole"));
  }
  EXPECT_GE(killed, rounds);
  RecordProperty("killed", killed);
  if (wanted) fmt::print("{} of {} runs were killed\n", killed, 8 * rounds);
}

TEST_F(StudyCommand, StoppedItSaysHowToGoOn) {
  for (double after = 0.1; after < 5.0; after *= 1.3) {  // until it is stopped neither before its runs nor after them
    fs::remove_all(file("out"));
    const Result run = nextview_behind(fmt::format("timeout --signal=TERM {:.3f}", after),
                                       fmt::format("study {} --out {}", quoted("study.toml"), quoted("out")));
    if (run.err.find("out; the same command with --resume goes on.\nnextview: stopped") != run.err.npos) return;
  }
  FAIL() << "it was never said";
}

TEST_F(StudyCommand, LeavesAFolderOfOthersAlone) {
  fs::create_directory(file("mine"));
  std::ofstream(file("mine") / "letter.txt") << "dear reader";
  for (const char* more : {"", "--resume"}) {
    const Result refused = study("mine", more);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("mine: is not empty, and holds no study"));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
  }
  EXPECT_EQ(content("mine"), (std::map<std::string, std::string>{{"letter.txt", "dear reader"}}));
  ASSERT_EQ(study("out", "--runs 3").exit_code, 0);
  EXPECT_THAT(study("out").err, HasSubstr("--resume goes on with it"));
  std::ofstream(file("broken.ply"), std::ios::app) << "x";
  const Result changed = study("out", "--resume");
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_THAT(changed.err, HasSubstr("other objects made it"));
  std::ofstream(file("study.toml"), std::ios::app) << "# x\n";
  EXPECT_THAT(study("out", "--resume").err, HasSubstr("another study"));
  EXPECT_THAT(nextview(fmt::format("study --merge {} --out {}", quoted("mine"), quoted("new"))).err,
              HasSubstr("is no folder of a study"));
}

TEST_F(StudyCommand, KeepsScansIfItIsAskedTo) {
  ASSERT_EQ(study("out", "--runs 4-4 --keep-scans").exit_code, 0);
  const auto kept = fs::directory_iterator(file("out") / "sessions")->path();
  const Result info = nextview(fmt::format("info '{}'", kept.string()));
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("3 views"));
}

TEST_F(StudyCommand, OptionsThatMakeNoSenseAreRefused) {
  for (const char* more : {"--shard 3/2", "--shard 0/2", "--shard 1", "--runs 0-3", "--runs 3-1", "--runs 1-99"}) {
    const Result refused = study("out", more);
    EXPECT_EQ(refused.exit_code, 2) << more;
    EXPECT_THAT(refused.err, HasSubstr(std::string(more).substr(0, 6))) << more;
    EXPECT_FALSE(fs::exists(file("out"))) << more;
  }
}

TEST(Study, WhatIsMissingOfItIsToldInOneLine) {
  for (const char* without : {"study", "study --out x"})
    EXPECT_EQ(
        nextview(without).err,
        "nextview: study: give either a study's FILE or --merge and its folders, and --out DIR; see nextview study "
        "--help\n");
  for (const char* without : {"study smoke", "study --merge a b"})
    EXPECT_EQ(nextview(without).err, "nextview: study: give the folder for its results, --out DIR\n");
  EXPECT_EQ(nextview("figure report").err, "nextview: figure report: give its folder, --out DIR\n");
  EXPECT_EQ(nextview("figure reprt").err, "nextview: there is no figure 'reprt'; did you mean 'report'?\n");
  EXPECT_EQ(
      nextview("figure report --study /no/such --out x").err,
      "nextview: /no/such: is no folder of a finished study, which has a summary.csv; give --study what `nextview "
      "study` wrote\n");
}

/// The small study that is shipped; all that it shows works.
TEST(Study, TheSmokeStudyRuns) {
  const TemporaryFolder folder;
  const Result run = nextview(fmt::format("study '{}/assets/studies/smoke.toml' --out '{}'", NEXTVIEW_SOURCE_DIR,
                                          (folder.path() / "out").string()));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const std::string csv = read_file(folder.path() / "out" / "summary.csv");
  for (const char* row :
       {"planning,1,(mean),clean,6,new-surface,gap_closed", "planning,1,(mean),clean,6,paper,coverage[%],6",
        "maps,2,(mean),noisy,4,gibbs,log_loss_near_surface[nats] - octomap",
        "maps,2,slotted_plate,clean,4,octomap,rows_open_by_width[%],10",
        "maps,2,(mean),noisy,4,calibrated,reliability_true,0.05"})
    EXPECT_THAT(csv, HasSubstr(row));
  const Result list = nextview("figure --list");
  const std::string from =
      fmt::format("--study '{}' --out '{}'", (folder.path() / "out").string(), (folder.path() / "figures").string());
  const std::string session = fmt::format("'{}'", (folder.path() / "scan").string());
  ASSERT_EQ(nextview("scan slotted_plate --sensor.width 80 --sensor.height 60 --resolution 0.04 --views.count 8 "
                     "--termination.views 3 --no-pictures --no-surfaces --out " +
                     session)
                .exit_code,
            0);
  const Result drawn = nextview(fmt::format("figure all {} --dpi 96 {}", session, from));
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  std::istringstream names(list.out);
  int figures = 0;
  for (std::string line; std::getline(names, line); ++figures) {
    const std::string name = line.substr(0, line.find(' '));
    if (name == "table_1" || name == "report") continue;
    for (const char* ending : {".png", ".json"})
      EXPECT_TRUE(fs::exists(folder.path() / "figures" / (name + ending))) << name << ending;
  }
  EXPECT_EQ(figures, 23);
  for (const char* chart : {"coverage_by_view.svg", "data_flow.svg", "gain_agreement.svg"})
    EXPECT_TRUE(fs::exists(folder.path() / "figures" / chart)) << chart;
  EXPECT_FALSE(fs::exists(folder.path() / "figures" / "strategy.svg"));  // it is of pixels
  EXPECT_TRUE(fs::exists(folder.path() / "figures" / "table_1.tex"));
  const Result info =
      nextview(fmt::format("info '{0}/coverage_by_view.png' '{0}/strategy.png'", (folder.path() / "figures").string()));
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("with the study that it shows:"), HasSubstr("with the settings that it")));
  EXPECT_THAT(read_file(folder.path() / "figures" / "report.html"), HasSubstr("<h1>Study smoke</h1>"));
  const Result refused =
      nextview(fmt::format("figure all --study '{0}' --out '{0}'", (folder.path() / "out").string()));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("something else than figures"));
  EXPECT_EQ(nextview("figure gap_close " + from).exit_code, 2);
  EXPECT_THAT(nextview("figure strategy /no/such " + from).err, HasSubstr("/no/such"));
  const fs::path nothing = folder.path() / "made" / "for_nothing";
  const Result fourth = nextview(fmt::format("figure strategy {} --views 2,4 --out '{}'", session, nothing.string()));
  EXPECT_EQ(fourth.exit_code, 2);
  EXPECT_THAT(fourth.err, HasSubstr("--views 4: slotted_plate has 3 views"));
  EXPECT_FALSE(fs::exists(nothing.parent_path()));
  EXPECT_THAT(nextview(fmt::format("figure strategy {} --out /dev/null/f", session)).err,
              HasSubstr("/dev/null/f: cannot be made a folder: Not a directory"));
}

}  // namespace
}  // namespace nextview
