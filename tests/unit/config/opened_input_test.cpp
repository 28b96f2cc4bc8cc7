#include "core/config/opened_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/config/object_lengths.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

TEST(WithInput, TellsRecordingsFromObjects) {
  EXPECT_EQ(with_input({}, "part.stl").object.file, "part.stl");
  EXPECT_EQ(with_input({}, "bunny").object.file, "bunny");
  EXPECT_EQ(with_input({}, "scans.graph").recorded.folder, "scans.graph");
  EXPECT_EQ(with_input({}, "scene.txt").recorded.folder, "scene.txt");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(with_input({}, folder).recorded.folder, folder);
}

TEST(WithInput, ForgetsTheRecordingBefore) {
  Configuration c = with_input({}, "scene.txt");
  c.recorded.truth = "part.stl";
  c.recorded.every = 3;
  c = with_input(c, "part.stl");
  EXPECT_EQ(c.recorded.folder, "");
  EXPECT_EQ(c.recorded.truth, "");
  EXPECT_EQ(c.recorded.every, 3) << "is how recordings are read, not which";
}

TEST(WithInput, ForgetsWhatFollowedFromTheObjectBefore) {
  Configuration c;
  c.map.resolution = 0.003;  // given
  fit_lengths(c, 2.0);
  set_unless_given(c, "termination.views", "7");
  ASSERT_NE(c.views.radius, Configuration().views.radius);
  c = with_input(c, "part.stl");
  EXPECT_EQ(c.views.radius, Configuration().views.radius);
  EXPECT_EQ(c.termination.views, Configuration().termination.views);
  EXPECT_EQ(c.map.resolution, 0.003);
}

TEST(WithNextInput, TakesNoUnitOrSizeFromTheFileBefore) {
  Configuration inches;
  inches.object.file = "part.stl";
  give(inches, "object.unit", "inch", "--object.unit");
  give(inches, "object.up", "y", "--object.up");
  give(inches, "object.longest_side", "0.3", "--object.longest_side");
  EXPECT_EQ(with_next_input(inches, "part.stl").object.unit, LengthUnit::inches);
  const Configuration next = with_next_input(inches, "other.stl");
  EXPECT_EQ(next.object.unit, LengthUnit::automatic);
  EXPECT_EQ(next.object.up, UpAxis::automatic);
  EXPECT_EQ(next.object.longest_side, 0.0) << "it would be scaled, and nothing said so";
  EXPECT_FALSE(next.sources.contains("object.unit"));
}

TEST(WithNextInput, TakesNoUnitFromTheObjectBeforeWhereSettingsNameAnother) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "mine.toml";
  Configuration inches;
  inches.object.file = "part.stl";
  give(inches, "object.unit", "inch", "--object.unit");
  const auto unit_after = [&](const char* toml) {
    std::ofstream(file) << toml;
    return with_next_input(inches, file).object.unit;
  };
  EXPECT_EQ(unit_after("[object]\nfile = 'other.stl'\n"), LengthUnit::automatic);
  EXPECT_EQ(unit_after("[object]\nfile = 'other.stl'\nunit = 'cm'\n"), LengthUnit::centimetres);
  EXPECT_EQ(unit_after("[planner]\ngain = 'random'\n"), LengthUnit::inches) << "the object stays";
}

TEST(NotAnInput, GoesByTheName) {
  for (const char* name : {"part.stl", "PART.STL", "a/part.ply.gz", "cloud.pcd", "cloud.pcd.gz", "scan.graph",
                           "scan.log", "scene.txt", "scene.txt.gz", "mine.toml", "figure.png", "map.ot", "map.bt"})
    EXPECT_EQ(not_an_input(name), "") << name;
  EXPECT_THAT(not_an_input("part.step"), testing::HasSubstr("export it as STL"));
  EXPECT_THAT(not_an_input("about.pdf"), testing::HasSubstr("'.pdf'"));
  EXPECT_THAT(not_an_input("scan.graph.gz"), testing::HasSubstr("'.graph'")) << "is read as it is";
  EXPECT_NE(not_an_input("README"), "");
}

TEST(WithInput, SaysWhatPlaysADemo) {
  try {
    with_input({}, "mine.nextview");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("mine.nextview: is a demo: `nextview demo` plays it"));
  }
}

TEST(SetUnlessGiven, LeavesWhatSomeoneWants) {
  Configuration c;
  give(c, "termination.views", "20", "--views");  // as by default, and yet given
  set_unless_given(c, "termination.views", "7");
  EXPECT_EQ(c.termination.views, 20);
  set_unless_given(c, "planner.cost_weight", "0");
  EXPECT_EQ(c.planner.weights.cost, 0.0);
  EXPECT_FALSE(is_given(c, "planner.cost_weight"));
}

}  // namespace
}  // namespace nextview
