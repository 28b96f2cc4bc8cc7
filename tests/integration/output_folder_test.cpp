// What a run may replace and remove in the folder that it writes to, and that its results can be read from anywhere.
#include "core/results/output_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const std::string quick_overwrite =
    " --views 2 --views.count 6 --sensor.width 60 --sensor.height 45 --map.resolution 0.04 --map.region_edge 0.8 "
    "--evaluation.surface_samples 200 --no-pictures --overwrite ";

class OutputFolder : public ::testing::Test {
 protected:
  fs::path in(const std::string& name) const { return folder_.path() / name; }
  fs::path copy(const char* part, const std::string& name) const {
    fs::create_directories(in(name).parent_path());
    fs::copy_file(std::string(NEXTVIEW_SOURCE_DIR "/assets/objects/") + part, in(name));
    return in(name);
  }
  /// Runs the program in the test's folder, so that arguments may be relative.
  Result run(const std::string& arguments, const std::string& folder = ".") const {
    const std::string out = in("stdout.txt").string(), err = in("stderr.txt").string();
    const std::string command = "cd '" + in(folder).string() +
                                "' && env -u DISPLAY -u WAYLAND_DISPLAY '" NEXTVIEW_PROGRAM "' " + arguments + " >'" +
                                out + "' 2>'" + err + "'";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_file(out), read_file(err)};
  }
  void expect_done(const std::string& arguments, const std::string& folder = ".") const {
    const Result result = run(arguments, folder);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const Result result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& word : words) EXPECT_THAT(result.err, HasSubstr(word)) << arguments;
  }
  /// Of every file below a folder what it holds, by its name.
  std::map<std::string, std::string> contents(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(in(name)))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), in(name)).string()] = read_file(entry.path());
    return all;
  }
  const TemporaryFolder folder_;
};

TEST_F(OutputFolder, AScanReplacesNothingThatItReads) {
  copy("sphere.ply", "io/surface_map.ply");
  copy("sphere.ply", "io/cloud.ply");
  fs::create_symlink("io/cloud.ply", in("link.ply"));
  const auto before = contents("io");
  expect_refused("scan io/surface_map.ply --out io" + quick_overwrite,
                 {"io/surface_map.ply: is the object", "--out io-2"});
  expect_refused("scan link.ply --out ./io/" + quick_overwrite, {"link.ply: is the object", "--out "});
  expect_refused("scan io/cloud.ply --no-surfaces --out io/../io" + quick_overwrite, {"io/cloud.ply"});
  expect_refused("calibrate io/cloud.ply --held-out box --views 2 --no-pictures --out io", {"io/cloud.ply"});
  EXPECT_EQ(contents("io"), before);
  expect_done("scan io/surface_map.ply --out io-2" + quick_overwrite);
  EXPECT_EQ(contents("io"), before);
}

TEST_F(OutputFolder, AnInputUnderAnotherNameMayLieInIt) {
  copy("slotted_plate.ply", "io/part.ply");
  copy("slotted_plate.json", "io/part.json");
  const auto before = contents("io");
  expect_done("scan io/part.ply --out io" + quick_overwrite);
  expect_done("scan io/part.ply --out io" + quick_overwrite);
  expect_done("refine io --out io/refined --no-pictures --gibbs.sweeps 20");
  auto after = contents("io");
  for (const auto& [name, text] : before) EXPECT_TRUE(after[name] == text) << name;
}

TEST_F(OutputFolder, AConfigurationThatIsReadStaysAndTheHintRepeatsTheScan) {
  fs::create_directories(in("a folder's"));
  const Result first = run("scan box --out \"a folder's/out\"" + quick_overwrite);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto before = contents("a folder's/out");
  expect_refused("scan --config \"a folder's/out/config.toml\" --out \"a folder's/out\"" + quick_overwrite,
                 {"config.toml: is read as configuration", "--out a folder's/out-2"});
  EXPECT_EQ(contents("a folder's/out"), before);
  const auto begin = first.out.find("nextview scan --config"), end = first.out.find('\n', begin);
  ASSERT_NE(begin, std::string::npos) << first.out;
  const std::string hint = first.out.substr(begin + 9, end - begin - 9);
  expect_done(hint + " --no-pictures");
  // The journal says where the object lies, as seen from there.
  auto again = contents("a folder's/out-2");
  for (const auto& [name, text] : before) EXPECT_TRUE(name == "timings.csv" || again[name] == text) << name;
  EXPECT_EQ(again.size(), before.size());
}

TEST_F(OutputFolder, TheDefaultIsTheNextThatIsFree) {
  expect_done("scan box" + quick_overwrite);
  expect_done("scan --config out/config.toml" + quick_overwrite);
  EXPECT_EQ(read_file(in("out-2/map.ot")), read_file(in("out/map.ot")));
  write_file(in("metrics.json"), "{}");
  expect_refused("scan box --views.layout file --views.file metrics.json --out ." + quick_overwrite,
                 {"metrics.json: is the views file", "--out ./results"});
  EXPECT_EQ(read_file(in("metrics.json")), "{}");
}

TEST_F(OutputFolder, RefineCalibrateAndScoreReplaceNothingThatTheyRead) {
  expect_done("scan box --out out" + quick_overwrite);
  const auto before = contents("out");
  expect_refused("refine out --out out --no-pictures", {"another folder", "--out out-2"});
  expect_refused("refine out --out out/../out/ --no-pictures", {"another folder"});
  expect_refused("calibrate out --out out --no-pictures", {"another folder"});
  EXPECT_EQ(contents("out"), before);
  expect_done("refine out --out refined --no-pictures --no-surfaces --gibbs.sweeps 20");
  expect_refused("refine refined --out again --no-pictures",
                 {"refined: holds no finished scan: it is what refine left"});
  write_file(in("scores.csv"), wall_scene(0.05));
  fs::create_hard_link(in("scores.csv"), in("wall.txt"));
  expect_refused("score --scene wall.txt --csv scores.csv", {"--csv scores.csv: is the scene"});
  expect_refused("refine wall.txt --out . --no-pictures", {"wall.txt"});
  EXPECT_EQ(read_file(in("scores.csv")), wall_scene(0.05));
}

TEST_F(OutputFolder, ALaterRunLeavesNothingOfAnEarlierOne) {
  expect_done(
      "scan box --views 4 --out out --gain gibbs --views.count 6 --sensor.width 60 --sensor.height 45 "
      "--map.resolution 0.04 --map.region_edge 0.8");
  write_file(in("out/notes.txt"), "mine");
  write_file(in("out/step_99.png"), "mine too");
  expect_done("scan box --no-surfaces --out out" + quick_overwrite);
  std::vector<std::string> names = file_names(in("out"));
  EXPECT_THAT(names, AllOf(Contains("notes.txt"), Contains("step_99.png"), Contains("map.ot")));
  for (const char* old : {"step_01.png", "step_04.png", "posterior.ot", "refinement.csv", "surface_posterior.ply",
                          "surface_posterior.stl", "surfaces.json"})
    EXPECT_THAT(names, Not(Contains(old)));
  const auto manifest = nlohmann::json::parse(read_file(in("out/manifest.json")));
  for (const std::string file : manifest["files"]) std::erase(names, file);
  EXPECT_EQ(names, (std::vector<std::string>{"manifest.json", "notes.txt", "scans", "step_99.png"}))
      << "all else is listed";
}

TEST_F(OutputFolder, BadInputLeavesTheResultsOfAnEarlierRun) {
  expect_done("scan box --out out" + quick_overwrite);
  const auto before = contents("out");
  write_file(in("bad.ply"), "ply\nnonsense");
  expect_refused("scan bad.ply --out out" + quick_overwrite, {"bad.ply"});
  expect_refused("scan missing.ply --out out" + quick_overwrite, {"missing.ply"});
  expect_refused("scan box --out out --map.region_edge 0.3" + std::string(" --no-pictures --overwrite"), {"region"});
  EXPECT_EQ(contents("out"), before);
  expect_refused("scan bad.ply --out new" + quick_overwrite, {"bad.ply"});
  EXPECT_FALSE(fs::exists(in("new"))) << "nothing is left behind";
}

TEST_F(OutputFolder, AStoppedOrKilledRunLeavesARightList) {
  const std::string scan = "env --default-signal=INT '" NEXTVIEW_PROGRAM
                           "' scan sphere --no-pictures --views 20 --out '" +
                           in("out").string() + "'";
  const std::string list = in("out/manifest.json").string();
  for (const std::string signal : {"INT", "KILL"}) {
    fs::remove_all(in("out"));
    // Neither a shell's background jobs (but for bash -m) nor what a job of one starts hears Ctrl+C otherwise.
    const std::string command = "bash -mc \"" + scan + " >/dev/null 2>&1 & while kill -0 \\$! 2>/dev/null && ! [ -e '" +
                                list + "' ]; do sleep 0.05; done; kill -" + signal + " \\$!; wait \\$!\" 2>/dev/null";
    EXPECT_NE(std::system(command.c_str()), 0) << signal << ": it was not stopped";
    ASSERT_TRUE(fs::exists(list)) << signal;
    std::vector<std::string> names = file_names(in("out"));
    const auto manifest = nlohmann::json::parse(read_file(list));
    for (const std::string file : manifest["files"]) std::erase(names, file);
    std::erase_if(names, [](const std::string& name) { return name.ends_with(".part"); });  // killed while writing it
    std::erase(names, "scans");                                                             // what is in it is listed
    EXPECT_EQ(names, (std::vector<std::string>{"manifest.json"})) << signal;
    if (!fs::exists(in("out/config.toml")))
      expect_refused("refine out --out refined --no-pictures", {"out: holds no finished scan"});
  }
}

TEST_F(OutputFolder, WhatIsNoSessionReplacesNone) {
  expect_done("scan box --out one" + quick_overwrite);
  expect_done("scan box --out two" + quick_overwrite);
  write_file(in("mine.nextview"), "wait 0.1\n");
  const auto before = contents("two");
  const std::vector<std::string> refusal = {"two: holds a session, which would be lost", "--out two-2"};
  expect_refused("refine one --out two --no-pictures", refusal);
  expect_refused("calibrate one --out two --no-pictures", refusal);
  expect_refused("calibrate box --fit new-surface --views 2 --out two", refusal);
  expect_refused("demo mine.nextview --out two --fps 10", refusal);
  EXPECT_EQ(contents("two"), before);
}

TEST_F(OutputFolder, AFolderWithAManifestOfSomethingElseIsLeftAlone) {
  fs::create_directories(in("site"));
  write_file(in("site/manifest.json"), "{\"name\": \"a web page\", \"icons\": []}");
  expect_refused("scan box --out site" + quick_overwrite, {"site/manifest.json", "another folder"});
  EXPECT_EQ(contents("site").size(), 1u);
}

TEST_F(OutputFolder, IsRefinedFromAnywhereAndAfterItWasMoved) {
  copy("box.ply", "here/part.ply");
  fs::create_directories(in("there/deep"));
  expect_done("scan part.ply --out out" + quick_overwrite, "here");
  expect_done("refine here/out --out one --no-pictures --no-surfaces --gibbs.sweeps 20");
  expect_done("refine ../../here/out --out ../two --no-pictures --no-surfaces --gibbs.sweeps 20", "there/deep");
  EXPECT_EQ(read_file(in("one/posterior.ot")), read_file(in("there/two/posterior.ot")));
  EXPECT_EQ(read_file(in("one/config.toml")), read_file(in("there/two/config.toml")));
  copy("box.ply", "here/out/inside.ply");
  expect_done("scan out/inside.ply --out out" + quick_overwrite, "here");
  EXPECT_EQ(toml_value(read_file(in("here/out/config.toml")), "file"), "") << "object and views: two";
  EXPECT_THAT(read_file(in("here/out/config.toml")), HasSubstr("file = 'inside.ply'"));
  fs::rename(in("here/out"), in("there/moved"));
  expect_done("refine there/moved --out three --no-pictures --no-surfaces --gibbs.sweeps 20");
}

// As 0.4.0 wrote it: a path relative to the folder that the program was run in, and no list.
TEST_F(OutputFolder, OfTheVersionBeforeIsStillReadWhereItWasMade) {
  copy("box.ply", "part.ply");
  expect_done("scan part.ply --out out" + quick_overwrite);
  std::string config = read_file(in("out/config.toml"));
  const std::string absolute = in("part.ply").string();
  config.replace(config.find(absolute), absolute.size(), "part.ply");
  write_file(in("out/config.toml"), config);
  fs::remove(in("out/manifest.json"));
  expect_done("refine out --out refined --no-pictures --no-surfaces --gibbs.sweeps 20");
  fs::create_directories(in("elsewhere"));
  const Result lost = run("refine ../out --out refined --no-pictures", "elsewhere");
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.err, AllOf(HasSubstr("out/config.toml:4: object.file: part.ply")));
  write_file(in("out/step_20.png"), "of the version before");
  expect_done("scan box --out out" + quick_overwrite);
  EXPECT_FALSE(fs::exists(in("out/step_20.png")));
}

TEST_F(OutputFolder, AChangedObjectIsNoticed) {
  copy("box.ply", "part.ply");
  expect_done("scan part.ply --out out" + quick_overwrite);
  fs::copy_file(NEXTVIEW_SOURCE_DIR "/assets/objects/sphere.ply", in("part.ply"), fs::copy_options::overwrite_existing);
  expect_refused("refine out --out refined --no-pictures",
                 {"part.ply", "has changed since out was scanned", "scan it again"});
  expect_refused("calibrate out --out calibrated --no-pictures", {"part.ply"});
  EXPECT_FALSE(fs::exists(in("refined")));
}

TEST_F(OutputFolder, AnUnrelatedFileBesideTheObjectIsNoFault) {
  copy("box.ply", "part.ply");
  expect_done("scan part.ply --out out" + quick_overwrite);
  for (const char* text : {"{\"version\": 3}", "[1, 2]", "no JSON", "", "{\"unit\": \"m\", \"openings\": [7]}"}) {
    write_file(in("part.json"), text);
    const Result result = run("refine out --out refined --no-pictures --no-surfaces --gibbs.sweeps 20");
    EXPECT_EQ(result.exit_code, 0) << text << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("notice: "), HasSubstr("part.json"))) << text;
    EXPECT_EQ(result.err.find("notice: "), result.err.rfind("notice: ")) << result.err;
  }
  ASSERT_EQ(std::system(("rm '" + in("part.json").string() + "' && mkfifo '" + in("part.json").string() + "'").c_str()),
            0);
  expect_done("refine out --out refined --no-pictures --no-surfaces --gibbs.sweeps 20");
}

TEST_F(OutputFolder, AFolderOfAKnownObjectsNameDoesNotHideIt) {
  expect_done("scan box --out box" + quick_overwrite);
  expect_done("scan box --out again" + quick_overwrite);
  expect_done("refine box --out refined --no-pictures --no-surfaces --gibbs.sweeps 20");
}

TEST_F(OutputFolder, SenselessSetupsAreToldBeforeTheFirstView) {
  const Result blind = run("scan box --out out --sensor.max_range 0.3" + quick_overwrite);
  EXPECT_EQ(blind.exit_code, 0);
  EXPECT_THAT(blind.err, AllOf(HasSubstr("warning: 7 of 7 views"), HasSubstr("sensor.max_range (300 mm)")));
  EXPECT_THAT(run("scan box --out out" + quick_overwrite).err, Not(HasSubstr("warning")));
}

}  // namespace
}  // namespace nextview
