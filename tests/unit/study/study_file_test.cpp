#include <gmock/gmock.h>

#include "core/study/study_folder.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

constexpr const char* small = R"(
[settings]
sensor.range_noise = 0.004
[sensor.noisy]
sensor.range_noise = 0.02
[policy.near]
planner.gain = "area-factor"
planner.cost_weight = 2
[[maps]]
objects = "box"
maps = ["octomap", "gibbs"]
views = [4, 8]
[[planning]]
objects = ["sphere", "missing.ply"]
sensors = ["noisy", "wide"]
policies = ["random", "near"]
starts = [[10, 5], [200, -30]]
seeds = [3, 7]
views = 6
)";

class StudyFile : public testing::Test {
 protected:
  Study read(const std::string& text) { return read_study(folder_.write("study.toml", text)); }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(StudyFile, ListsItsRunsInAFixedOrder) {
  const Study study = read(small);
  ASSERT_EQ(study.size(), 2u * 2 * 2 * 2 * 2 + 2 * 2);  // plans come first, wherever they stand
  std::size_t i = 0;
  for (const char* object : {"sphere", "missing.ply"})
    for (const char* sensor : {"noisy", "wide"})
      for (const char* policy : {"random", "near"})
        for (const char* start : {"10 5", "200 -30"})
          for (const std::uint64_t seed : {3u, 7u}) {
            const StudyRun run = study.run(i++);
            EXPECT_EQ(run.part, StudyPart::planning);
            EXPECT_EQ(run.object, object);
            EXPECT_EQ(run.sensor, sensor);
            EXPECT_EQ(run.method, policy);
            EXPECT_EQ(run.start, start);
            EXPECT_EQ(run.seed, seed);
            EXPECT_EQ(run.views, 6);
          }
  EXPECT_EQ(study.run(i).method, "octomap");
  EXPECT_EQ(study.run(i + 1).method, "gibbs");
  EXPECT_EQ(study.run(i + 1).views, 4);
  EXPECT_EQ(study.run(i + 2).views, 8);
}

TEST_F(StudyFile, HasNoRunBeyondItsLast) {
  const Study study = read(small);
  EXPECT_EQ(study.run(study.size() - 1).method, "gibbs");
  EXPECT_EQ(study.run(study.size() - 1).views, 8);
  EXPECT_THROW(study.run(study.size()), std::out_of_range);
}

TEST_F(StudyFile, ARunIsSaidInWords) {
  const Study study = read(small);
  EXPECT_EQ(study.run(1).text(), "sphere, noisy, 6 views, random, start 10 5, seed 7");
  EXPECT_EQ(study.run(16).text(), "missing, noisy, 6 views, random, start 10 5, seed 3") << "without the file's ending";
  EXPECT_EQ(study.run(32).text(), "box, default, 4 views, octomap, seed 1") << "a map has no start view";
}

TEST_F(StudyFile, WhatANameMeansOverridesTheSettingsOfAll) {
  const Study study = read(small);
  const Configuration noisy = configuration_of(study, study.run(0)), wide = configuration_of(study, study.run(8));
  EXPECT_EQ(noisy.sensor.range_noise, 0.02);
  EXPECT_EQ(wide.sensor.range_noise, 0.004);  // of the preset 0.005
  EXPECT_EQ(wide.sensor.field_of_view, 86.0);
  EXPECT_EQ(noisy.planner.gain, "random");
  const Configuration near = configuration_of(study, study.run(7));
  EXPECT_EQ(near.planner.gain, "area-factor");
  EXPECT_EQ(near.planner.weights.cost, 2.0);
  EXPECT_EQ(near.planner.start_azimuth, 200.0);
  EXPECT_EQ(near.planner.start_elevation, -30.0);
  EXPECT_EQ(noisy.planner.start_azimuth, 10.0);
  EXPECT_EQ(noisy.planner.start_elevation, 5.0);
  EXPECT_EQ(near.seed, 7u);
  EXPECT_EQ(near.termination.views, 6);
  EXPECT_EQ(near.termination.surface_left, 0.0);
}

TEST_F(StudyFile, SaysWhereItIsWrong) {
  const auto expect = [&](const std::string& text, const std::string& place, const std::string& reason) {
    EXPECT_THAT(error_of(text), HasSubstr((folder_ / "study.toml").string() + place)) << text;
    EXPECT_THAT(error_of(text), HasSubstr(reason)) << text;
    EXPECT_EQ(error_of(text).find('\n'), std::string::npos) << text;
  };
  const std::string block = "[[planning]]\nobjects = [\"box\"]\npolicies = [\"random\"]\n";
  expect("", ": ", "compares nothing");
  expect("[settings\n", ":1: ", "");
  expect(block + "[settings]\nsensor.widht = 3\n", ":5: ", "did you mean 'sensor.width'?");
  expect(block + "[settings]\nsensor.width = -3\n", ":5: ", "must be");
  expect(block + "[settings]\nsensor.width = \"wide\"\n", ":5: ", "takes a whole number");
  expect(block + "[settings]\nseed = 3\n", ":5: ", "no setting of a study");
  expect(block + "[policy.mine]\nconfig = \"paper\"\ngain = \"random\"\n", ":6: ", "did you mean 'planner.gain'?");
  expect(block + "sensors = [\"mine\"]\n[sensor.mine]\nsensor.width = -3\n", ":6: ", "must be");
  expect(block + "polices = []\n", ":4: ", "did you mean");
  expect("[[planning]]\nobjects = [\"box\"]\npolicies = [\"randm\"]\n", ":3: ", "did you mean 'random'?");
  expect("[[maps]]\nobjects = [\"box\"]\nmaps = [\"octmap\"]\n", ":3: ", "did you mean 'octomap'?");
  expect("[[maps]]\nmaps = [\"octomap\"]\n", ":1: ", "needs 'objects'");
  expect(block + "views = 0\n", ":4: ", "from 1 to 1000");
  expect(block + "starts = [[30]]\n", ":4: ", "pairs");
  expect(block + "starts = [[30, 100]]\n", ":1: ", "start_elevation");
  expect(block + "sensors = [\"none\"]\n", ":1: ", "there is no sensor 'none'");
  expect(block + "reference = \"oracle\"\n", ":1: ", "is none of the block's policies");
  expect(block + "seeds = []\n", ":4: ", "must have from 1");
  expect("[[planning]]\nobjects = [\"a/part.ply\", \"b/part.obj\"]\npolicies = [\"random\"]\n",
         ":1: ", "two objects are called 'part'");
  expect("[[planning]]\nobjects = [\"box\"]\npolicies = [\"random\", \"random\"]\n",
         ":1: ", "'random' stands twice in 'policies'");
  expect(block + "seeds = [1, 2, 1]\n", ":1: ", "'1' stands twice in 'seeds'");
  expect(block + "starts = [[30, 20], [30, 20]]\n", ":1: ", "'30 20' stands twice in 'starts'");
}

TEST_F(StudyFile, AKeyFollowsFromWhatMakesTheResultAndFromNothingElse) {
  std::filesystem::copy_file(NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply", folder_ / "part.ply");
  const std::string block =
      "[[planning]]\nobjects = [\"part.ply\"]\npolicies = [\"random\", \"oracle\"]\nseeds = [1, 2]\n";
  const auto keys = [&](const std::string& text) { return keys_of(read(text)).keys; };
  const auto before = keys(block);
  EXPECT_EQ((std::set<std::string>(before.begin(), before.end()).size()), 4u);
  EXPECT_EQ(keys("# a remark\n" + block), before);
  EXPECT_EQ(keys("[settings]\nsensor.width = 640\n" + block), before);  // as it is by default
  EXPECT_NE(keys("[settings]\nsensor.width = 320\n" + block)[0], before[0]);
  const auto turned = keys("[policy.oracle]\nplanner.gain = \"oracle\"\nplanner.cost_weight = 3\n" + block);
  EXPECT_EQ(turned[0], before[0]);
  EXPECT_NE(turned[2], before[2]);
  const std::filesystem::path elsewhere = folder_ / "elsewhere";
  std::filesystem::create_directory(elsewhere);
  std::filesystem::copy_file(folder_ / "part.ply", elsewhere / "part.ply");
  std::ofstream(elsewhere / "study.toml") << block;
  EXPECT_EQ(keys_of(read_study(elsewhere / "study.toml")).keys, before);
  std::ofstream(folder_ / "part.ply", std::ios::app) << " ";
  EXPECT_NE(keys(block)[0], before[0]);
}

}  // namespace
}  // namespace nextview
