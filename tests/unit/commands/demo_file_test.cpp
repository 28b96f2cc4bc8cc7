// Demos as files: those that come with the program, what one may write, and what it needs.
#include "ui/commands/demo_file.hpp"

#include <gmock/gmock.h>

#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DemoFiles : public testing::Test {
 protected:
  Demo read(const std::string& text, const std::filesystem::path& out = {}) const {
    return read_demo(folder_.write("mine.nextview", text).string(), out);
  }
  /// What is wrong with it, behind the file's name.
  std::string error_of(const std::string& text, const std::filesystem::path& out = {}) const {
    try {
      read(text, out);
    } catch (const std::runtime_error& error) {
      const std::string file = (folder_ / "mine.nextview").string() + ":", what = error.what();
      EXPECT_TRUE(what.starts_with(file)) << what;
      return what.substr(file.size());
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST(DemoNames, AreThoseOfTheFilesInTheirOrder) {
  const std::filesystem::path demos = NEXTVIEW_SOURCE_DIR "/assets/demos";
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(demos))
    if (entry.path().extension() == ".nextview") there.insert(entry.path().stem().string());
  ASSERT_TRUE(there.contains("tour"));
  EXPECT_EQ(demo_names(), std::vector<std::string>(there.begin(), there.end()));
}

TEST(DemoNames, EachIsReadByItsName) {
  const Demo tour = read_demo("tour");
  EXPECT_EQ(tour.file.filename(), "tour.nextview");
  EXPECT_GT(tour.calls.size(), 10u);
  EXPECT_EQ(tour.needs, "") << "it opens what comes with the program";
  EXPECT_EQ(read_demo("recorded").needs, "Debian's package visp-images-data");
  for (const auto& [wanted, hint] :
       {std::pair{"toor", "; did you mean 'tour'?"}, {"show", "; there are compare, gibbs, recorded, tour"}}) {
    try {
      read_demo(wanted);
      ADD_FAILURE() << "there is none of this name";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), fmt::format("there is no demo '{}', nor a file of this name{}", wanted, hint));
    }
  }
}

TEST_F(DemoFiles, CallsHaveTheirLines) {
  const Demo demo = read("# mine\n\nopen sphere\nstep  # one\n");
  EXPECT_EQ(demo.file, folder_ / "mine.nextview");
  ASSERT_EQ(demo.calls.size(), 2u);
  EXPECT_EQ(demo.calls[0].text(), "open sphere");
  EXPECT_EQ(demo.calls[0].line, 3);
  EXPECT_EQ(demo.calls[1].line, 4);
  EXPECT_EQ(error_of("step\nstepp\n"), "2: there is no command 'stepp'; did you mean 'step'?");
  EXPECT_EQ(error_of("# nothing\n"), " has no commands");
  EXPECT_THROW(read_demo((folder_ / "none.nextview").string()), std::runtime_error);
}

TEST_F(DemoFiles, SayWhatTheyNeedAtTheBeginOfALine) {
  EXPECT_EQ(read("# mine\n# needs: a scanner\nstep\n").needs, "a scanner");
  EXPECT_EQ(read("# mine\nstep\n# needs: a scanner").needs, "a scanner") << "also where the file ends";
  EXPECT_EQ(read("step  # needs: a scanner\n").needs, "");
}

TEST_F(DemoFiles, PlayNoOtherAndStartNoProgram) {
  EXPECT_EQ(error_of("step\nplay-demo tour\n"), "2: play-demo: a demo plays no other");
  EXPECT_EQ(error_of("open other.nextview\n"), "1: open: a demo plays no other");
  EXPECT_EQ(error_of("connect \"rm -r\"\n"), "1: connect: a demo starts no program");
}

TEST_F(DemoFiles, WriteBelowTheirFolderAlone) {
  const std::filesystem::path out = folder_ / "out";
  EXPECT_EQ(error_of("step\nexport-cloud a.ply\n"), "2: export-cloud: a demo writes below --out only; give one");
  for (const char* outside : {"/tmp/a.ply", "../a.ply", "deeper/../../a.ply"})
    EXPECT_EQ(error_of(std::string("export-cloud ") + outside + "\n", out),
              std::string("1: export-cloud: a demo writes below --out only, not ") + outside);
  const auto written = [&](const std::string& file) {
    const Demo demo = read("step\nexport-cloud " + file + "\n", out);
    EXPECT_EQ(demo.calls[1].line, 2);
    return demo.calls[1].values().front();
  };
  EXPECT_EQ(written("a.ply"), (out / "a.ply").string());
  EXPECT_EQ(written("deeper/a.ply"), (out / "deeper/a.ply").string());
  EXPECT_EQ(written("deeper/../a.ply"), (out / "a.ply").string());
  EXPECT_EQ(read("open sphere\n", out).calls[0].values().front(), "sphere") << "what is read stays where it is";
}

TEST_F(DemoFiles, WhatTheyOpenAndIsNotThereIsNamed) {
  const std::string there = folder_.write("there.ply", "").string();
  const Demo whole = read("open sphere\nopen " + there + "\nstep\n");
  EXPECT_THAT(missing_data(whole), IsEmpty());
  EXPECT_NO_THROW(require_data(whole));
  const Demo lacking = read("# mine\n# needs: luck\nopen sphere\nopen nowhere.ply\nopen nothing.ply\n");
  const auto missing = missing_data(lacking);
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_THAT(missing[0], testing::StartsWith((folder_ / "mine.nextview").string() + ":4: "));
  EXPECT_THAT(missing[0], HasSubstr("nowhere.ply"));
  EXPECT_THAT(missing[0], testing::EndsWith("; it needs luck"));
  EXPECT_THAT(missing[1], HasSubstr(":5: "));
  EXPECT_THAT(missing_data(read("open nowhere.ply\n")).front(), testing::Not(HasSubstr("it needs")));
  try {
    require_data(lacking);
    ADD_FAILURE() << "two files are missing";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), missing[0]);
  }
}

}  // namespace
}  // namespace nextview
