// Control bar, status line, log: numbers, units, states.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <utility>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;

class Bars : public testing::Test {
 protected:
  Bars() { desk_.snapshot = scan_; }
  std::string control_bar() { return seen_in("Control bar"); }
  std::string status() { return seen_in("Status"); }
  std::string seen_in(const char* window) {
    desk_.frames();
    return read(window);
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_{1280, 960};
};

TEST_F(Bars, TheFiguresAreThoseOfTheLastView) {
  int placed = 0;
  const auto has = [&](const char* value, const char* name) {
    EXPECT_THAT(control_bar(), HasSubstr(value));
    EXPECT_THAT(control_bar(), HasSubstr(name));
    const auto all = seen_texts();
    const SeenText *v = find_text(all, value, "Control bar"), *n = find_text(all, name, "Control bar");
    if (v && n) {
      EXPECT_NEAR(v->to.x, n->to.x, 2) << value << " does not stand above " << name;
      ++placed;
    }
  };
  has("62.5 %", "of visible surface");
  has("4.500 Mbit", "unmeasured entropy");
  has("2 / 4", "views");
  scan_->configuration.termination.views = 1;
  EXPECT_THAT(control_bar(), Not(HasSubstr("/"))) << "the limit was lowered, and says nothing of them";
  desk_.snapshot = scanned(small_scan(), 0);
  has("0.0 %", "of visible surface");
  has(fmt::format("{:.3f} Mbit", double(scan_->grid.voxel_count()) / 1e6).c_str(), "unmeasured entropy");
  has("0 / 4", "views");
  EXPECT_GT(placed, 0) << "no figure was found by itself";
  scan_->configuration.evaluation.enabled = false;
  desk_.snapshot = scan_;
  EXPECT_THAT(control_bar(), Not(HasSubstr("surface")));
}

TEST_F(Bars, SaysWhichCandidateIsNextInASmallWindow) {
  scan_->next_candidate = 46;
  Desk small(640, 480);
  small.snapshot = scan_;
  small.frames();
  EXPECT_THAT(read("Control bar"), HasSubstr("Next: candidate 46"));
}

TEST_F(Bars, SaysWhatItIsReadyFor) {
  EXPECT_THAT(control_bar(), HasSubstr("Ready to take candidate 6"));
  scan_->next_candidate.reset();
  EXPECT_THAT(control_bar(), HasSubstr("No candidate is left"));
  scan_->custom_next_view = true;
  EXPECT_THAT(control_bar(), HasSubstr("Ready to take your custom view"));
  scan_->finished = "the gain is small";
  EXPECT_THAT(control_bar(), HasSubstr("Finished: the gain is small"));
  desk_.snapshot = scanned(small_scan(), 0);
  EXPECT_THAT(control_bar(), HasSubstr("Ready to take the start view"));
  desk_.snapshot = std::make_shared<SessionSnapshot>();
  EXPECT_THAT(control_bar(), HasSubstr("Nothing is open"));
  desk_.progress.opening = true;
  EXPECT_THAT(control_bar(), AllOf(HasSubstr("Opening…"), Not(HasSubstr("Nothing is open"))));
}

TEST_F(Bars, SaysWhatRunsWhatWaitsAndForHowLong) {
  desk_.progress.busy = true;
  desk_.progress.what = "scoring";
  desk_.progress.waiting = 2;
  desk_.progress.seconds_left = 12;
  desk_.progress.fraction = 0.25;
  EXPECT_THAT(control_bar(), HasSubstr("scoring, 2 more to do, about 12 s left"));
  EXPECT_THAT(control_bar(), Not(HasSubstr("Ready")));
  const auto done = seen_areas(theme::series[0], "Control bar");  // the primary button and the bar
  const auto all = seen_texts();
  const SeenText *text = find_text(all, "scoring", "Control bar"), *cancel = find_text(all, "Cancel", "Control bar");
  ASSERT_TRUE(text && cancel);
  bool found = false;
  for (const ImRect& area : done) {
    if (area.GetHeight() > 9 || area.Min.x < text->from.x - 2) continue;
    found = true;
    EXPECT_NEAR(area.GetWidth() / (cancel->from.x - area.Min.x), 0.25, 0.05);
  }
  EXPECT_TRUE(found) << "there is no bar";
  desk_.progress.paused = true;
  EXPECT_THAT(control_bar(), HasSubstr("paused: scoring"));
  EXPECT_EQ(text_of(click_on(desk_, "Cancel", "Control bar")), "cancel");
  desk_.progress = {};
  desk_.progress.busy = desk_.progress.playing = true;
  EXPECT_THAT(control_bar(), HasSubstr("between two views"));
}

TEST_F(Bars, ACancelIsAcknowledgedUntilWhatRunsHasStopped) {
  desk_.progress.busy = desk_.progress.cancelling = true;
  desk_.progress.what = "sampling";
  EXPECT_THAT(control_bar(), HasSubstr("Cancelling …"));
  EXPECT_EQ(text_of(click_on(desk_, "Cancelling", "Control bar")), "");
  Desk narrow(480, 480);
  narrow.snapshot = scan_;
  narrow.progress = desk_.progress;
  narrow.frames();
  EXPECT_THAT(read("Control bar"), HasSubstr("Cancelling …"));
}

TEST_F(Bars, ASurfaceThatIsMadeIsSeenWhileNothingElseRuns) {
  desk_.surface_progress = SurfaceJob{0.5, 12};
  EXPECT_THAT(control_bar(), HasSubstr("making the surface, about 12 s left"));
  EXPECT_THAT(control_bar(), Not(HasSubstr("Ready")));
  desk_.progress.busy = true;
  desk_.progress.what = "scoring";
  EXPECT_THAT(control_bar(), HasSubstr("scoring"));
  EXPECT_THAT(control_bar(), Not(HasSubstr("making the surface")));
}

TEST_F(Bars, WhatRunsEndsWhereItsCancelBegins) {
  desk_.progress.busy = true;
  desk_.progress.what =
      "casting rays of sight, voxel by voxel, through all of the region that nobody has seen yet, again";
  desk_.progress.waiting = 2;
  desk_.progress.seconds_left = 0;
  EXPECT_THAT(control_bar(), Not(HasSubstr("left"))) << "0 s are not worth a word, and others are cut";
  const auto all = seen_texts();
  const SeenText *text = find_text(all, "casting", "Control bar"), *cancel = find_text(all, "Cancel", "Control bar");
  ASSERT_TRUE(text && cancel);
  EXPECT_LT(text->to.x, cancel->from.x);
}

TEST_F(Bars, PlayAndPauseAreOneButtonAndStepWaitsWhilePlaying) {
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Play", "Control bar")), "play");
  EXPECT_EQ(text_of(click_on(desk_, "Step", "Control bar")), "step");
  desk_.progress.busy = desk_.progress.playing = true;
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Pause", "Control bar")), "pause");
  EXPECT_EQ(text_of(click_on(desk_, "Step", "Control bar")), "") << "views are being taken";
  desk_.progress = {};
  desk_.progress.pause_between_views = 1.5;
  EXPECT_THAT(control_bar(), HasSubstr("+1.5 s"));
}

TEST_F(Bars, TheStatusLineSumsUpTheLastStepAndTheScan) {
  EXPECT_THAT(status(), HasSubstr("View 2: 500 points, 214 cm² of new surface, 15.75 s")) << "all stages";
  const Eigen::Vector3i cube = scan_->grid.size, n = cube + Eigen::Vector3i(0, 1, 2);
  scan_->grid.size = n;
  EXPECT_THAT(status(), HasSubstr(fmt::format("sphere · {} triangles · {} × {} × {} voxels of 40 mm",
                                              scan_->mesh->triangles.size(), n.x(), n.y(), n.z())));
  scan_->grid.size = cube;
  const double usual = std::exchange(scan_->records.back().new_surface, 0.0612);
  EXPECT_THAT(status(), HasSubstr(", 6.12 mm² of new surface")) << "of a small part all are less than 1 cm²";
  scan_->records.back().new_surface = usual;
  desk_.window.pointed_at = Vector3(0.0125, -0.2, 0.31);
  EXPECT_THAT(status(), HasSubstr("x 12.5  y -200.0  z 310.0 mm"));
  desk_.window.pointed_at = Vector3(1.25, -0.2, 0.31);
  EXPECT_THAT(status(), HasSubstr("x 1.250  y -0.200  z 0.310 m"));
  desk_.window.pointed_at = Vector3(0.0125, -1e-5, -0.0);
  EXPECT_THAT(status(), HasSubstr("x 12.5  y 0.0  z 0.0 mm")) << "0 has no sign";
  scan_->message = "it went wrong";
  scan_->failures = 1;
  EXPECT_EQ(status(), "it went wrong");
  EXPECT_EQ(text_of(click_on(desk_, "it went wrong", "Status")), "dismiss");
  EXPECT_THAT(status(), HasSubstr("View 2: 500 points"));
  EXPECT_FALSE(command::dismiss.available(desk_.state())) << "it was taken away";
  scan_->failures = 2;
  EXPECT_EQ(status(), "it went wrong") << "again";
  desk_.snapshot = scanned(small_scan(), 0);
  EXPECT_THAT(status(), HasSubstr("Nothing measured yet"));
}

TEST_F(Bars, TheStatusLineSaysThatARecordingRuns) {
  desk_.window.recording = DemoRecording{"/somewhere/mine.nextview", 0};
  EXPECT_THAT(status(), HasSubstr("Recording mine.nextview · View 2: "));
}

TEST_F(Bars, TheStatusLineSaysThatNothingIsKept) {
  EXPECT_THAT(status(), testing::Not(HasSubstr("kept")));
  scan_->keeping_fails = true;
  EXPECT_THAT(status(), HasSubstr("Nothing is kept: Ctrl+E exports · View 2: "));
}

TEST_F(Bars, TheLogHasAllAndNotificationsWhatMatters) {
  desk_.window.bring_to_front("log");
  desk_.frames();
  desk_.log = {{LogEntry::Level::note, "a note"},
               {LogEntry::Level::success, "it is done"},
               {LogEntry::Level::warning, "it went wrong"}};
  EXPECT_EQ(seen_in("Log"), "a note it is done it went wrong");
  EXPECT_EQ(read("Notifications"), "it is done it went wrong");
  const auto all = seen_texts();
  EXPECT_EQ(find_text(all, "it went wrong", "Log")->colour, to_imgui_u32(theme::chosen));
  EXPECT_EQ(find_text(all, "it is done", "Log")->colour, to_imgui_u32(theme::series[2]));
  for (int frame = 0; frame < 7 * 60; ++frame) desk_.frame();
  EXPECT_EQ(read("Notifications"), "it went wrong") << "a warning stays longer";
}

TEST_F(Bars, NoNumberOfANotificationComesApart) {
  desk_.frames();
  std::string text = "The chains say";
  for (int i = 0; i < 40; ++i) text += fmt::format(" {}.406", std::string(std::size_t(1 + i % 7), '1'));
  desk_.log = {{LogEntry::Level::warning, text}};
  desk_.frames();
  EXPECT_GT(read_lines("Notifications").size(), 3u);
  for (const std::string& line : read_lines("Notifications")) EXPECT_FALSE(line.ends_with(".")) << line;
}

TEST_F(Bars, ANumberStaysWithItsUnit) {
  desk_.frames();
  std::string text = "Of the surface";
  for (int i = 0; i < 40; ++i) text += fmt::format(" {} %", std::string(std::size_t(1 + i % 7), '1'));
  desk_.log = {{LogEntry::Level::warning, text}};
  desk_.frames();
  EXPECT_GT(read_lines("Notifications").size(), 3u);
  for (const std::string& line : read_lines("Notifications")) EXPECT_FALSE(line.starts_with("%")) << line;
}

TEST_F(Bars, ANotificationGoesOnceItIsNoNews) {
  desk_.frames();
  scan_->message = "part.stl: no such file";
  desk_.log = {{LogEntry::Level::warning, scan_->message}, {LogEntry::Level::warning, "the ranking says little"}};
  EXPECT_EQ(seen_in("Notifications"), "part.stl: no such file the ranking says little");
  scan_->message.clear();
  EXPECT_EQ(seen_in("Notifications"), "the ranking says little") << "now it went well";
  desk_.progress.opening = true;
  EXPECT_EQ(seen_in("Notifications"), "") << "that was another object";
  desk_.log.push_back({LogEntry::Level::warning, "the next one is small"});
  EXPECT_EQ(seen_in("Notifications"), "the next one is small");
}

TEST_F(Bars, AClickOnANotificationIsTheScenesAndTakesItAway) {
  desk_.frames();
  desk_.log = {{LogEntry::Level::success, "it is done"}};
  desk_.frames();
  const std::vector<SeenText> texts = seen_texts();
  const SeenText* const note = find_text(texts, "it is done", "Notifications");
  ASSERT_NE(note, nullptr);
  const ImVec2 at(note->from.x + 5, note->middle());
  desk_.move(at.x, at.y);
  desk_.frames();
  EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse) << "what is beneath it cannot be measured or turned";
  desk_.click(at.x, at.y);
  EXPECT_EQ(seen_in("Notifications"), "");
}

TEST_F(Bars, WhatIsSaidAgainWithMoreIsReadOnce) {
  desk_.frames();
  desk_.log = {{LogEntry::Level::warning, "The scanner is lost"}};
  desk_.frames();
  desk_.log.push_back({LogEntry::Level::warning, "step: the scanner is lost; reach it again"});
  EXPECT_EQ(seen_in("Notifications"), "The scanner is lost; reach it again");
}

TEST(Notifications, InANarrowWindowStepPlayAndTabsStayInReach) {
  for (const auto& [width, height] : {std::pair{640, 480}, {1000, 700}, {1280, 800}}) {
    Desk desk(width, height);
    desk.snapshot = made_scan();
    desk.frames();
    desk.log = {{LogEntry::Level::warning, "it went wrong"}};
    desk.frames();
    const ImGuiWindow* const notes = ImGui::FindWindowByName("Notifications");
    ASSERT_TRUE(notes && notes->WasActive);
    const Rectangle& bar = desk.layout().control_bar;
    EXPECT_GE(notes->Pos.y, bar.y + bar.height) << width;
    EXPECT_LE(notes->Pos.x + notes->Size.x, desk.layout().right.x) << width;
  }
}

TEST_F(Bars, NotificationsLeaveOutTheNamesOfCommands) {
  desk_.window.bring_to_front("log");
  desk_.frames();
  desk_.log = {{LogEntry::Level::warning, "previous-view: there is no earlier view"},
               {LogEntry::Level::warning, "part.stl: no such file"}};
  EXPECT_EQ(seen_in("Notifications"), "There is no earlier view part.stl: no such file");
  EXPECT_EQ(read("Log"), "previous-view: there is no earlier view part.stl: no such file");
}

}  // namespace
}  // namespace nextview
