// One thing of a session from the command line, and its views ranked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/file/png_text.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Export : public testing::Test {
 protected:
  Export() {
    const Result scan = nextview(
        "scan sphere --views 3 --sensor.width 80 --sensor.height 60 --views.count 8 --map.resolution 0.02 "
        "--evaluation.surface_samples 500 --gain occlusion-aware --no-pictures --no-surfaces --out " +
        in("out"));
    EXPECT_EQ(scan.exit_code, 0) << scan.err;
  }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string bytes(const std::string& name) const { return read_file(in(name)); }
  void write(const std::string& what, const std::string& name, const std::string& options = "") const {
    const Result run = nextview("export " + in("out") + " " + what + " " + in(name) + " " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr(in(name)));
  }
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const Result run = nextview(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  TemporaryFolder folder_;
};

TEST_F(Export, WritesWhatTheScanWroteAndLeavesTheSessionAlone) {
  std::map<std::string, std::string> before;
  for (const auto& entry : fs::recursive_directory_iterator(in("out")))
    if (entry.is_regular_file()) before[entry.path().string()] = read_file(entry.path());
  write("cloud", "c.ply");
  write("map", "m.ot");
  write("map", "m.bt");
  write("views", "v.csv");
  write("curves", "s.csv");
  write("curves", "s.svg");
  write("views", "v.json");
  write("surface", "s.stl", "--unseen");
  EXPECT_EQ(bytes("c.ply") == bytes("out/cloud.ply"), true);
  EXPECT_EQ(bytes("m.ot") == bytes("out/map.ot"), true);
  EXPECT_EQ(bytes("m.bt") == bytes("out/map.bt"), true);
  EXPECT_EQ(bytes("v.csv"), bytes("out/views.csv"));
  EXPECT_EQ(bytes("s.csv"), bytes("out/steps.csv"));
  EXPECT_EQ(nlohmann::json::parse(bytes("v.json")).size(), 3u);
  EXPECT_TRUE(fs::exists(in("s_unseen.stl")));
  for (const auto& [name, was] : before) EXPECT_EQ(read_file(name) == was, true) << name;
  EXPECT_EQ(std::size_t(std::count_if(fs::recursive_directory_iterator(in("out")), fs::recursive_directory_iterator(),
                                      [](const auto& entry) { return entry.is_regular_file(); })),
            before.size());
}

/// A scan of that many views is the oracle.
TEST_F(Export, AStepIsTheScanAsItWasThen) {
  write("views", "two.csv", "--step 2");
  const std::string all = bytes("out/views.csv");
  EXPECT_EQ(bytes("two.csv"), all.substr(0, all.find("\n3,") + 1));
  ASSERT_EQ(
      nextview("scan --config " + in("out/config.toml") + " --views 2 --no-pictures --no-surfaces --out " + in("two"))
          .exit_code,
      0);
  write("map", "two.ot", "--step 2");
  EXPECT_EQ(bytes("two.ot") == bytes("two/map.ot"), true);
  write("cloud", "two.ply", "--step 2");
  EXPECT_EQ(bytes("two.ply") == bytes("two/cloud.ply"), true);
  expect_refused("export " + in("out") + " map " + in("x.ot") + " --step 4", "--step 4: " + in("out") + " has 3 views");
}

TEST_F(Export, PicturesHaveTheirSizeAndTheirConfiguration) {
  write("picture", "p.png", "--size 320x200 --transparent --layers object,views");
  write("curves", "c.png", "--size 700x500");
  const PngInfo info = read_png_info(in("p.png"));
  EXPECT_EQ(info.width, 320u);
  EXPECT_EQ(info.height, 200u);
  EXPECT_EQ(read_png_info(in("c.png")).height, 500u);
  EXPECT_THAT(png_configuration(in("p.png")), HasSubstr("gain = 'occlusion-aware'"));
  const Result told = nextview("info " + in("p.png"));
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("320 x 200 pixels by Nextview"));
  EXPECT_THAT(told.out, HasSubstr("gain = 'occlusion-aware'"));
  const Result again =
      nextview("scan --config " + in("p.png") + " --views 1 --no-pictures --no-surfaces --out " + in("again"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(bytes("again/config.toml"), HasSubstr("gain = 'occlusion-aware'"));
}

TEST_F(Export, PicturesAreLookedAtFromAnyDirectionOfTheSphere) {
  const std::string picture = "export " + in("out") + " picture " + in("a.png") + " --size 64x48 --look-from ";
  write("picture", "usual.png", "--size 64x48");
  for (const char* direction : {"-360,-90", "360,90", "'30, -12.5'"}) {
    write("picture", "a.png", std::string("--size 64x48 --look-from ") + direction);
    EXPECT_NE(bytes("a.png"), bytes("usual.png")) << direction;
  }
  write("picture", "a.png", "--size 64x48 --look-from -50,24");  // the default
  EXPECT_EQ(bytes("a.png") == bytes("usual.png"), true);
  for (const char* direction :
       {"360.5,0", "-360.5,0", "0,90.5", "0,-90.5", "nan,0", "0,inf", "30", "30,", "30;20", "30,20,10", "30,20x"})
    expect_refused(picture + "'" + direction + "'", "the second from -90 to 90, not '" + std::string(direction) + "'");
}

TEST_F(Export, ATurntableReplacesAnEarlierOneAndNothingElse) {
  write("turntable", "turn", "--frames 4 --size 160x100");
  EXPECT_NE(bytes("turn/frame_00001.png"), bytes("turn/frame_00002.png"));
  write("turntable", "turn", "--frames 2 --size 160x100");
  EXPECT_FALSE(fs::exists(in("turn/frame_00003.png")));
  expect_refused("export " + in("out") + " turntable " + in("out"), "the session's folder");
}

TEST_F(Export, BadCallsAreToldInOneLineAndNothingIsLost) {
  const std::string out = "export " + in("out") + " ", journal = bytes("out/journal"),
                    config = bytes("out/config.toml");
  expect_refused(out + "clod " + in("a.ply"), "did you mean 'cloud'?");
  expect_refused(out + "cloud " + in("a.xyz"), "a cloud can be written as .ply or .pcd");
  expect_refused(out + "cloud /proc/a.ply", "/proc/a.ply");
  expect_refused(out + "cloud " + in("no/a.ply"), in("no/a.ply"));
  expect_refused("export " + in("nowhere") + " cloud " + in("a.ply"), "nowhere: there is no such folder");
  expect_refused(out + "views " + in("out/scans/a.csv"), "among the session's scans");
  fs::create_symlink(in("out/journal"), in("link.txt"));
  expect_refused(out + "views " + in("link.txt"), "the session's journal");
  expect_refused(out + "cloud " + in("a.ply") + " --size 64x64", "--size");
  expect_refused(out + "surface " + in("a.ply") + " --of cloud --unseen", "--unseen: is an option of surface --of map");
  expect_refused(out + "picture " + in("a.png") + " --size 64", "WIDTHxHEIGHT");
  expect_refused(out + "picture " + in("a.png") + " --look-from 3", "--look-from");
  expect_refused(out + "picture " + in("a.png") + " --layers ground", "'ground'");
  expect_refused(out + "cloud", "FILE is required: where to; its ending says the format");
  expect_refused(out, "WHAT is required: cloud (.ply or .pcd), map (.ot or .bt), ");
  EXPECT_EQ(bytes("out/journal"), journal);
  EXPECT_EQ(bytes("out/config.toml"), config);
  for (const char* name : {"a.ply", "a.xyz", "a.png", "no"}) EXPECT_FALSE(fs::exists(in(name))) << name;
}

/// The session's own gain ranked its candidates after the last view: scores.csv is the oracle.
TEST_F(Export, ScoreRanksTheSessionAsItStands) {
  const Result run = nextview("score " + in("out") + " --csv " + in("scores.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::set<std::ptrdiff_t> numbers_begin;  // in letters: the columns stand one below the other
  std::istringstream told(nextview("score " + in("out")).out);
  std::string heading, empty;
  std::getline(std::getline(told, heading), empty);
  for (std::string row; std::getline(told, row) && row.find(':') != row.npos;)
    numbers_begin.insert(
        std::ranges::count_if(row.substr(0, row.find(':')), [](char c) { return (c & 0xc0) != 0x80; }));
  EXPECT_EQ(numbers_begin.size(), 1u) << heading;
  std::istringstream scored(bytes("scores.csv")), ranked(bytes("out/scores.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
  };
  std::string line;
  std::getline(scored, line);
  const auto head = cells(line);
  const auto column = std::size_t(std::ranges::find(head, "occlusion-aware") - head.begin());
  ASSERT_LT(column, head.size());
  std::map<std::string, std::vector<std::string>> of_view;
  while (std::getline(scored, line)) of_view[cells(line)[0]] = cells(line);
  EXPECT_EQ(of_view.size(), 8u);
  int compared = 0, taken = 0;
  while (std::getline(ranked, line)) {
    const auto row = cells(line);  // step, view, available, gain
    if (row[0] != "3") continue;
    if (row[2] == "1") {
      EXPECT_EQ(of_view.at(row[1])[column], row[3]) << "view " << row[1];
      ++compared;
    } else {
      EXPECT_EQ(of_view.at(row[1])[column], "");
      ++taken;
    }
  }
  EXPECT_EQ(compared + taken, 8);
  EXPECT_GE(taken, 2);
  expect_refused("score", "SESSION or --scene");
  expect_refused("score " + in("nowhere"), "nowhere: there is no such folder");
  expect_refused("score " + in("out") + " --csv " + in("out/journal"), "the session's journal");
  const Result one = nextview("score " + in("out") + " --gain area-factor");
  EXPECT_THAT(one.out, HasSubstr("8 candidate views"));
  EXPECT_THAT(one.out, HasSubstr("area-factor"));
}

}  // namespace
}  // namespace nextview
