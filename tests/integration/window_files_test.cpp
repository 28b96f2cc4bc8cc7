// Pictures and scripts that the window writes and plays.
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "core/file/atomic_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

std::string bytes_of(const std::filesystem::path& file) { return read_file(file); }

/// What the window's script says, in a folder of its own.
class WindowFiles : public InTemporaryFolder {
 protected:
  std::string file(const char* name) const { return (folder_ / name).string(); }
  /// What is asked when a new file, which holds this, is dropped.
  std::string question_on_dropping(User& user, const char* name, const std::string& text) const {
    write_file(folder_ / name, text);
    user.drop(file(name));
    user.wait_for_news();
    return user.window().question();
  }
};

TEST_F(WindowFiles, APictureIsWithoutWhatIsInFront) {
  User user(small_scan());
  user.run("step\nsave-picture " + file("plain.png") + "\n");  // leaves a notice
  const Layout layout = user.window().layout();
  const Image before = user.look();
  user.run("palette\n");
  user.write("view");
  user.wait();
  ASSERT_NE(user.look(), before);
  user.run("save-picture " + file("palette.png") + "\n");
  user.run("palette\nshortcuts\nsave-picture " + file("sheet.png") + "\nshortcuts\n");
  user.click(20, layout.menu.height / 2);
  user.wait();
  user.move(640, 5);  // off the menu's button
  user.wait();
  user.run("save-picture " + file("menu.png") + "\n");
  for (const char* other : {"palette.png", "sheet.png"})
    EXPECT_EQ(bytes_of(file(other)), bytes_of(file("plain.png"))) << other;
  EXPECT_GT(std::filesystem::file_size(file("menu.png")), 10'000u);
}

/// Though what it does between them is drawn with less care.
TEST_F(WindowFiles, APictureThatAScriptWritesIsDrawnWell) {
  User user(small_scan(), 640, 400, 0.5);
  user.run("step\nstep\nlook-from 20 30\nsave-picture " + file("at_once.png") + "\n");
  user.run("toggle-region\ntoggle-region\n");
  user.run("save-picture " + file("at_rest.png") + "\n");
  EXPECT_EQ(read_png(file("at_once.png")), read_png(file("at_rest.png")));
  user.window().run_script(parse_script("zoom 1\nstep\n"));
  user.window().draw(1.0 / 60);
  EXPECT_FALSE(user.window().is_drawn_well()) << "the next line comes at once";
  user.wait();
}

TEST_F(WindowFiles, LinesOfAScriptThatFailAreToldAndTheOthersDone) {
  User user(small_scan());
  std::vector<std::string> failures;
  user.window().script().set_on_failure(
      [&](const ScriptFailure& f) { failures.push_back(std::to_string(f.line) + " " + f.reason); });
  user.run_quickly(
      "step\n\nexport /proc/no/such\nopen /no/such/file.ply\n# a comment\ntake-view 999\nstep\nsave-picture " +
      file("no/picture.png") + "\nsave-script /proc/no/script\nundo\nset sensor.max_range -1\nstep\n");
  ASSERT_EQ(failures.size(), 6u) << testing::PrintToString(failures);
  EXPECT_EQ(failures[0].substr(0, 10), "3 export: ");
  EXPECT_EQ(failures[1].substr(0, 8), "4 open: ");
  EXPECT_NE(failures[1].find("/no/such/file.ply"), std::string::npos) << failures[1];
  EXPECT_EQ(failures[2], "6 take-view: view 999 is not available");
  EXPECT_EQ(failures[3].substr(0, 16), "8 save-picture: ");
  EXPECT_EQ(failures[4].substr(0, 14), "9 save-script:");
  EXPECT_EQ(failures[5].substr(0, 7), "11 set:");
  EXPECT_EQ(user.session().records.size(), 2u);
  EXPECT_TRUE(user.window().script_is_done());
}

TEST_F(WindowFiles, WhatFailedIsToldUntilSomethingElseIsDone) {
  User user(small_scan());
  const auto is_told = [&] {
    const WorkerProgress rest;
    return command::dismiss.available({user.session(), rest, user.window().state()});
  };
  user.run_quickly("step\n");
  EXPECT_FALSE(is_told());
  for (const std::string& other : {"export-picture " + file("p.png"), "export-cloud " + file("c.ply")}) {
    user.run_quickly("open /no/such/file.ply\n");
    EXPECT_TRUE(is_told());
    user.run_quickly(other + "\n");
    EXPECT_FALSE(is_told()) << other;
  }
}

TEST_F(WindowFiles, OfSeveralFilesThatAreDroppedItIsSaidWhichIsOpened) {
  User user(small_scan());
  user.wait();
  user.drop("box", 2);
  user.wait();
  EXPECT_EQ(user.session().object_name, "box");
  const ImGuiWindow* const notes = ImGui::FindWindowByName("Notifications");
  EXPECT_TRUE(notes && notes->WasActive) << "it went with what was said of the object before";
}

TEST_F(WindowFiles, SettingsThatAreDroppedAskBeforeTheyStartTheScanOver) {
  User user(small_scan());
  user.run_quickly("step\nstep\n");
  EXPECT_EQ(question_on_dropping(user, "wrong.toml", "[map]\nresolutoin = 0.01\n"), "") << "it is refused";
  EXPECT_EQ(question_on_dropping(user, "gone.toml", "[object]\nfile = \"/no/such/part.stl\"\n"), "")
      << "what it scans is not there";
  EXPECT_EQ(question_on_dropping(user, "mine.toml", "[sensor]\nrange_noise = 0.001\n"),
            "Taking the settings of mine.toml starts the scan over. Its 2 views are set "
            "aside: undo brings them back.");
  EXPECT_EQ(user.session().records.size(), 2u);
}

/// Who says that the Gibbs map may go for a file is not to hear then that the file is broken.
TEST_F(WindowFiles, AMeshThatIsCutOffAsksNothingAndLosesNothing) {
  User user(small_scan());
  user.run_quickly("step\nrefine 2 8\n");
  EXPECT_EQ(question_on_dropping(user, "cut.stl", "solid cut\n"), "");
  EXPECT_NE(user.session().message.find("cut.stl: is truncated"), std::string::npos) << user.session().message;
  EXPECT_EQ(user.session().records.size(), 1u);
  EXPECT_EQ(user.session().gibbs_lost, 1u) << "it is still there";
  user.drop("box");
  user.wait_for_news();
  EXPECT_NE(user.window().question(), "");
  EXPECT_EQ(user.session().object_name, "sphere");
}

TEST_F(WindowFiles, AMapAloneFillsTheSceneAndHasNoFirstSteps) {
  User user(small_scan());
  user.window().show_guide(true);
  user.run_quickly("step\nexport-map " + file("map.ot") + "\n");
  SceneView& scene = user.window().scene();
  const auto distance = [&] { return (scene.camera_pose().translation() - user.session().grid.box().center()).norm(); };
  user.run_quickly("open " + file("map.ot") + "\n");
  const double opened = distance();
  user.run_quickly("frame all\n");
  EXPECT_NEAR(opened, distance(), 1e-6) << "its region is much larger";
  const ImGuiWindow* const guide = ImGui::FindWindowByName("First steps");
  EXPECT_FALSE(guide && guide->WasActive) << "there is no first view to be taken";
}

TEST(Window, AScriptThatEndsTooEarlyHasFailed) {
  User user(small_scan());
  std::vector<int> lines;
  user.window().script().set_on_failure([&](const ScriptFailure& f) { lines.push_back(f.line); });
  user.window().run_script(parse_script("step\nstep\n\nstep\n"));
  user.window().draw(1.0 / 60);
  user.window().draw(1.0 / 60);
  user.window().script().give_up("the window was closed");
  EXPECT_FALSE(lines.empty());
  EXPECT_LE(lines.size(), 2u);
  EXPECT_TRUE(user.window().script_is_done());
  user.wait_for_news();
}

}  // namespace
}  // namespace nextview
