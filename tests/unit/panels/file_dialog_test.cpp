// The file dialog by keyboard and mouse, on folders that are made for it.
#include <gmock/gmock.h>

#include <fstream>

#include "core/session/untitled_sessions.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/panels/desk.hpp"
#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

class FileDialogTest : public testing::Test {
 protected:
  FileDialogTest() {
    for (const char* name : {"parts/bracket.stl", "parts/my own part.ply", "parts/older/arm.obj"}) {
      std::filesystem::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name) << "12345";
    }
    open_all_ways(desk_);
  }
  void begin(const std::string& command) {
    desk_.window.file_for = command;
    desk_.frames();
    desk_.write((folder_ / "parts").string() + "/");
    desk_.frames();
  }
  /// What comes of it, but for the dialog's closing.
  std::string done() {
    for (const CommandCall& call : desk_.frames())
      if (call.command->name != "file-dialog") return call.text();
    return "";
  }
  bool is_open() const { return !desk_.window.file_for.empty(); }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
  Desk desk_;
};

TEST_F(FileDialogTest, APartOfANameAndEnterOpenAFile) {
  begin("open");
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "");
  EXPECT_TRUE(is_open()) << "a folder is looked into";
  desk_.write("OWN");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/my own part.ply")));
  EXPECT_FALSE(is_open());
}

TEST_F(FileDialogTest, ArrowsChooseAndTabCompletes) {
  begin("open");
  desk_.type(Key::enter);
  desk_.frames();
  desk_.type(Key::down);  // older/, bracket.stl
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/bracket.stl")));
  begin("open");
  desk_.write("ol");
  desk_.frames();
  desk_.type(Key::tab);
  desk_.frames();
  desk_.write("arm");
  desk_.frames();
  desk_.type(Key::tab);
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/older/arm.obj")));
}

TEST_F(FileDialogTest, WhatCannotBeOpenedComesLast) {
  std::ofstream(folder_ / "parts/about the bracket.pdf") << "12345";
  begin("open");
  desk_.type(Key::enter);
  desk_.frames();
  desk_.write("brack");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/bracket.stl")));
  begin("open");
  desk_.write("about");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "");
  EXPECT_TRUE(is_open());
  EXPECT_THAT(read("File"), testing::HasSubstr("no known mesh file type"));
}

/// Their folders are called by the time alone, as far as there is room for it.
TEST_F(FileDialogTest, ARecentSessionIsCalledByWhatWasScanned) {
  const char* const before = std::getenv("XDG_STATE_HOME");
  const std::string was = before ? before : "";
  setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
  {
    SessionRunner runner;
    runner.keep_sessions(state_folder(), {});
    const SessionRunner::JobControl control{[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
    runner.load(small_scan(), control);
    runner.step(control);
  }
  begin("open");
  before ? setenv("XDG_STATE_HOME", was.c_str(), 1) : unsetenv("XDG_STATE_HOME");
  EXPECT_THAT(read("File"), testing::HasSubstr("sphere, 1 view"));
}

/// Letters that were meant for the path were commands of the window once it had closed.
TEST_F(FileDialogTest, AFileThatCannotBeReadIsToldWhereItWasChosen) {
  begin("open");
  desk_.type(Key::enter);
  desk_.frames();
  desk_.write("brack");
  desk_.frames();
  desk_.progress.busy = desk_.progress.opening = true;
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/bracket.stl")));
  EXPECT_FALSE(is_open());
  auto failed = std::make_shared<SessionSnapshot>(*desk_.snapshot);
  ++failed->failures;
  failed->message = path("parts/bracket.stl") + ": it has no triangles";
  desk_.snapshot = failed;
  desk_.progress = {};
  desk_.frames();
  EXPECT_TRUE(is_open());
  EXPECT_THAT(read("File"), testing::HasSubstr(" bracket.stl: it has no triangles"));
  EXPECT_THAT(read("File"), testing::HasSubstr("brack "));
  desk_.type(Key::escape);
  desk_.frames();
  EXPECT_FALSE(is_open());
  begin("open");
  EXPECT_THAT(read("File"), testing::Not(testing::HasSubstr("no triangles"))) << "it is begun anew";
}

TEST_F(FileDialogTest, OpensTheFolderThatIsWrittenOrChosenOrShown) {
  const auto opens = [&] {
    std::string opened;
    for (const CommandCall& call : click_on(desk_, "Open this folder", "File"))
      if (call.command->name == "open") opened = call.text();
    return opened;
  };
  begin("open");
  EXPECT_EQ(opens(), "open " + quoted(path("parts"))) << "that the first row is a folder was not chosen";
  begin("open");
  desk_.write("older");
  desk_.frames();
  EXPECT_EQ(opens(), "open " + quoted(path("parts/older")));
  begin("open");
  click_on(desk_, "older/", "File");
  EXPECT_EQ(opens(), "open " + quoted(path("parts/older")));
}

TEST_F(FileDialogTest, ANameThatIsCutIsInATooltip) {
  const std::string name = "a part with a name that is longer than any list of files that anybody has ever drawn " +
                           std::string("in a window of this size.ply");
  std::ofstream(folder_ / "parts" / name) << "12345";
  begin("open");
  desk_.type(Key::enter);
  desk_.frames();
  const auto all = seen_texts();
  const SeenText* const row = find_text(all, "a part with");
  ASSERT_TRUE(row);
  desk_.move(row->from.x + 5, row->middle());
  for (int frame = 0; frame < 40; ++frame) desk_.frame();
  EXPECT_EQ(read_tooltip(), name);
}

TEST_F(FileDialogTest, APathThatIsNotThereOpensNothingAndCanBeMended) {
  begin("open");
  desk_.write("gone/brac");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "");
  EXPECT_TRUE(is_open());
  EXPECT_THAT(read("File"), testing::HasSubstr("brac: there is no such file"));
  desk_.type_with(key('A'), true);
  desk_.write(path("parts/brac"));
  desk_.frames();
  EXPECT_THAT(read("File"), testing::Not(testing::HasSubstr("there is no such file"))) << "another is being written";
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open " + quoted(path("parts/bracket.stl")));
  begin("open");
  EXPECT_THAT(read("File"), testing::HasSubstr("bracket.stl")) << "the folder is seen before Enter";
}

TEST_F(FileDialogTest, EscapeClosesItAndNothingElse) {
  begin("open");
  const Selection selected = desk_.window.selection;
  desk_.type(Key::escape);
  EXPECT_EQ(done(), "");
  EXPECT_FALSE(is_open());
  EXPECT_EQ(desk_.window.selection, selected);
}

TEST_F(FileDialogTest, SaysInWhichCoordinatesItWrites) {
  auto scan = std::make_shared<SessionSnapshot>(*made_scan());
  for (const bool centred : {true, false}) {
    scan->configuration.object.centred = centred;
    desk_.snapshot = std::make_shared<const SessionSnapshot>(*scan);
    begin("export-surface");
    EXPECT_THAT(read("File"), testing::HasSubstr(centred ? "the object's middle in the origin"
                                                         : "the origin that of the object's file"));
    desk_.type(Key::escape);
    desk_.frames();
  }
  begin("export-picture");
  EXPECT_THAT(read("File"), testing::Not(testing::HasSubstr("In metres")));
}

/// The surface of the map, or of the points; what is shown is proposed.
TEST_F(FileDialogTest, AsksWhichSurfaceIsWrittenAndSaysInWhichFormats) {
  desk_.window.layers.surface = true;
  for (const auto& [clicked, written] : {std::pair{"", " cloud seen"}, {"map", " map seen"}, {"all", " cloud all"}}) {
    begin("export-surface");
    EXPECT_THAT(read("File"), testing::HasSubstr("A file that ends in .ply or .stl."));
    if (*clicked) click_on(desk_, clicked, "File");
    desk_.write("mine");
    desk_.frames();
    desk_.type(Key::enter);
    EXPECT_EQ(done(), "export-surface " + quoted(path("parts/mine.ply")) + written);
  }
}

TEST_F(FileDialogTest, AFormatThatThereIsNotIsToldBeforeItCloses) {
  begin("export-surface");
  desk_.write("mine.obj");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "");
  EXPECT_TRUE(is_open());
  EXPECT_THAT(read("File"), testing::HasSubstr("mine.obj: a surface can be written as .ply or .stl"));
}

TEST_F(FileDialogTest, NothingIsReplacedUnasked) {
  begin("export-surface");
  desk_.type_with(key('A'), true);
  desk_.write(path("parts/bracket.stl"));
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "") << "it is there already";
  EXPECT_TRUE(is_open());
  EXPECT_THAT(read("File"), testing::HasSubstr("bracket.stl is there already."));
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "export-surface " + quoted(path("parts/bracket.stl")) + " map seen");
}

TEST_F(FileDialogTest, AnEndingThatIsLeftOutIsAddedBeforeItAsks) {
  std::ofstream(folder_ / "parts/mine.nextview") << "12345";
  begin("record");
  desk_.type_with(key('A'), true);
  desk_.write(path("parts/mine"));
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "");
  EXPECT_THAT(read("File"), testing::HasSubstr("mine.nextview is there already."));
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "record " + quoted(path("parts/mine.nextview")));
}

TEST_F(FileDialogTest, AnExportIsProposedANameThatNoSessionHas) {
  begin("export");
  desk_.type_with(key('A'), true);
  desk_.write(path("parts/my_scan"));
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "export " + quoted(path("parts/my_scan")));
  for (const char* next : {"my_scan-2", "my_scan-3"}) {
    std::filesystem::create_directories(folder_ / "parts/my_scan");
    std::ofstream(folder_ / "parts/my_scan/journal") << "{}";
    if (next == std::string("my_scan-3")) {
      std::filesystem::create_directories(folder_ / "parts/my_scan-2");
      std::ofstream(folder_ / "parts/my_scan-2/journal") << "{}";
    }
    desk_.window.file_for = "export";
    desk_.frames();
    desk_.type(Key::enter);
    EXPECT_EQ(done(), "export " + quoted(path("parts") + "/" + next));
  }
}

TEST_F(FileDialogTest, WhatIsProposedIsWrittenOverEveryTime) {
  std::string command;
  for (const Key last : {Key::escape, Key::escape, Key::enter}) {
    desk_.window.file_for = "export";
    desk_.frames();
    desk_.write("mine");
    desk_.frames();
    desk_.type(last);
    command = done();
  }
  EXPECT_THAT(command, testing::EndsWith("/mine"));
}

TEST_F(FileDialogTest, AFileIsNotOfferedToBeReplacedByAFolder) {
  begin("export");
  desk_.write("bracket.stl");
  desk_.frames();
  for (int time = 0; time < 2; ++time) {
    desk_.type(Key::enter);
    EXPECT_EQ(done(), "");
    EXPECT_TRUE(is_open());
  }
}

TEST_F(FileDialogTest, AnObjectThatComesWithTheProgramIsOpenedByItsName) {
  begin("open");
  desk_.type(Key::enter);
  desk_.frames();
  desk_.write("sphere");
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "open sphere");
}

TEST_F(FileDialogTest, ADemosFileIsPlayed) {
  std::ofstream(folder_ / "parts/bracket.nextview") << "step\n";
  begin("play-demo");
  desk_.type(Key::enter);
  desk_.frames();
  EXPECT_THAT(read("File"), testing::HasSubstr("Play a demo"));
  desk_.write("bracket");  // of two the one that is a demo
  desk_.frames();
  desk_.type(Key::enter);
  EXPECT_EQ(done(), "play-demo " + quoted(path("parts/bracket.nextview")));
  EXPECT_FALSE(is_open());
}

TEST_F(FileDialogTest, WhereNothingCouldBeWrittenIsNotProposedAgain) {
  const auto export_to = [&](const std::string& file) {
    begin("export-cloud");
    desk_.type_with(key('A'), true);
    desk_.write(file);
    desk_.frames();
    desk_.type(Key::enter);
    desk_.frames();
    ASSERT_FALSE(is_open());
  };
  const auto proposes = [&](const char* name) {
    desk_.window.file_for = "export-cloud";
    desk_.frames();
    const bool found = read("File").find(name) != std::string::npos;
    desk_.type(Key::escape);
    desk_.frames();
    return found;
  };
  export_to(path("parts/cloud.ply"));
  std::ofstream(folder_ / "parts/cloud.ply") << "written";
  EXPECT_TRUE(proposes("bracket.stl"));
  export_to(path("parts/older/cloud.ply"));
  EXPECT_TRUE(proposes("bracket.stl")) << "it was not written";
}

TEST_F(FileDialogTest, KeysOfCommandsDoNothingBehindIt) {
  begin("open");
  desk_.type(key('S'));
  desk_.type(Key::space);
  EXPECT_EQ(done(), "");
}

}  // namespace
}  // namespace nextview
