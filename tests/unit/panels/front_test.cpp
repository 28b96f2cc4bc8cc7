// What is in front of the panels has the keyboard: menus, lists, the palette, the sheet of keys, texts.
#include <gmock/gmock.h>

#include "tests/unit/panels/seen.hpp"
#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

using testing::IsEmpty;

std::vector<std::string> names(const std::vector<CommandCall>& calls) {
  std::vector<std::string> result;
  for (const CommandCall& call : calls) result.push_back(call.text());
  return result;
}

int open_popups() { return ImGui::GetCurrentContext()->OpenPopupStack.Size; }

void open_menu(Desk& desk) {
  desk.frames();
  desk.click(20, desk.layout().menu.height / 2);
  desk.frames();
  ASSERT_EQ(open_popups(), 1) << "no menu opened";
}

TEST(Front, EscapeClosesAMenuAndNothingElse) {
  Desk desk;
  open_all_ways(desk);
  const Selection selected = desk.window.selection;
  open_menu(desk);
  desk.type(Key::escape);
  EXPECT_THAT(names(desk.frames()), IsEmpty());
  EXPECT_EQ(open_popups(), 0);
  EXPECT_EQ(desk.window.selection, selected);
  desk.type(Key::escape);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"clear-selection"}) << "with nothing open it is a shortcut";
}

TEST(Front, EscapeClosesAMenuWithinAMenuAndLeavesTheOuterOne) {
  Desk desk;
  open_all_ways(desk);
  open_menu(desk);
  const auto all = seen_texts();
  const SeenText* const recent = find_text(all, "Open recent");
  ASSERT_NE(recent, nullptr);
  desk.move(recent->from.x + 10, recent->middle());
  desk.frames();
  ASSERT_EQ(open_popups(), 2) << "the menu within it did not open";
  desk.type(Key::escape);
  desk.frames();
  EXPECT_EQ(open_popups(), 1);
  desk.type(Key::escape);
  desk.frames();
  EXPECT_EQ(open_popups(), 0);
}

TEST(Front, NoShortcutFiresWhileAMenuIsOpen) {
  Desk desk;
  open_all_ways(desk);
  for (const Command& command : commands())
    for (const Shortcut& shortcut : command.shortcuts()) {
      if (shortcut.key == Key::escape) continue;
      if (open_popups() == 0) open_menu(desk);
      desk.type_with(shortcut.key, shortcut.control, shortcut.shift);
      EXPECT_THAT(names(desk.frames()), IsEmpty()) << shortcut.text();
    }
}

/// Nothing that acts on the session is done behind a question; Enter gives the first answer, Escape the last.
TEST(Front, AQuestionIsAnsweredFirst) {
  Desk desk;
  open_all_ways(desk);
  desk.progress.question = "Start over?";
  desk.progress.answers = {"Start over", "Cancel"};
  desk.type(Key::space);
  for (const CommandCall& call : desk.frames()) {
    CommandTarget target{desk.worker(), desk.window, *desk.snapshot, desk.progress};
    EXPECT_THROW(call.run(target), std::invalid_argument) << "what is refused says so";
  }
  for (const Command& command : commands()) {
    if (command.menu != "Scan" || command.name == "answer" || command.name == "cancel") continue;
    EXPECT_FALSE(command.available(desk.state())) << command.name;
  }
  desk.look();
  desk.type(Key::enter);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer \"Start over\""});
  desk.progress.costs = true;
  desk.type(Key::enter);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer Cancel"}) << "who is in a hurry loses nothing";
  desk.type(Key::escape);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer Cancel"});
}

/// Who went to a button by keys sees which one Enter presses, whatever Enter does without that.
TEST(Front, EnterPressesTheAnswerThatHasTheRing) {
  Desk desk;
  desk.progress.question = "Leave without keeping?";
  desk.progress.answers = {"Quit", "Export", "Cancel"};
  desk.progress.costs = true;
  desk.look();
  for (const auto& [key, does] : {std::pair{Key::tab, "answer Quit"}, {Key::right, "answer Export"}}) {
    desk.type(key);
    desk.frames();
    desk.type(Key::enter);
    EXPECT_EQ(names(desk.frames()), std::vector<std::string>{does});
  }
  desk.type(Key::escape);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer Cancel"});
}

TEST(Front, WhatAnAnswerDoesIsToldWithItsKey) {
  Desk desk;
  desk.progress.question = "Go on with it?";
  desk.progress.answers = {"Go on", "Begin anew", "Ask later"};
  desk.progress.effects = {"Opens it", "It stays kept", "Asks again"};
  desk.frames();
  for (const auto& [answer, does] :
       {std::pair{"Go on", "Opens it [Enter]"}, {"Begin anew", "It stays kept"}, {"Ask later", "Asks again [Esc]"}}) {
    const auto all = seen_texts();
    const SeenText* const button = find_text(all, answer, "Question");
    ASSERT_TRUE(button) << answer;
    desk.move(button->from.x, button->middle());
    for (int frame = 0; frame < 40; ++frame) desk.frame();
    EXPECT_EQ(read_tooltip(), does);
  }
}

/// A robot moves for it, and nobody has seen the next question by then.
TEST(Front, TheSecondClickOfADoubleClickAnswersNoOtherQuestion) {
  Desk desk;
  desk.progress.question = "Go there?";
  desk.progress.answers = {"Move", "Refuse"};
  desk.progress.question_number = 1;
  desk.frames();
  const auto all = seen_texts();
  const SeenText* const button = find_text(all, "Move", "Question");
  ASSERT_TRUE(button);
  const auto click = [&] {
    desk.click(button->from.x + 4, button->middle());
    return names(desk.frames());
  };
  EXPECT_EQ(click(), std::vector<std::string>{"answer Move"});
  desk.progress.question_number = 2;
  EXPECT_THAT(click(), IsEmpty());
  for (int frame = 0; frame < 40; ++frame) desk.frame();
  EXPECT_EQ(click(), std::vector<std::string>{"answer Move"}) << "it was seen by then";
}

/// Nor has anybody read it who presses Enter twice.
TEST(Front, EnterAnswersAQuestionThatWasInSightForAMoment) {
  Desk desk;
  desk.progress.answers = {"Move", "Refuse"};
  const auto press = [&](Key key) {
    desk.type(key);
    return names(desk.frames());
  };
  for (const auto& [number, question] : {std::pair{1, "Go there?"}, {2, "Go there?"}, {2, "And there?"}}) {
    desk.progress.question = question;
    desk.progress.question_number = std::uint64_t(number);
    EXPECT_THAT(press(Key::enter), IsEmpty()) << "nobody saw it";
    EXPECT_THAT(press(Key::enter), IsEmpty()) << "nor read it";
    desk.look();
    EXPECT_EQ(press(Key::enter), std::vector<std::string>{"answer Move"});
  }
  desk.progress.question_number = 3;
  EXPECT_EQ(press(Key::escape), std::vector<std::string>{"answer Refuse"}) << "that costs nothing";
}

/// The palette lies over the question: whoever closes it has not answered.
TEST(Front, EscapeCancelsWhatRunsAndElseSelectsNothing) {
  Desk desk;
  open_all_ways(desk);
  desk.progress.busy = desk.progress.refining = true;
  desk.type(Key::escape);
  auto calls = desk.frames();
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls[0].text(), "cancel") << "what is selected stays";
  desk.progress = {};
  desk.type(Key::escape);
  calls = desk.frames();
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls[0].text(), "clear-selection");
}

TEST(Front, EscapeClosesThePaletteBeforeItAnswers) {
  Desk desk;
  open_all_ways(desk);
  desk.progress.question = "Move the robot?";
  desk.progress.answers = {"Move", "Cancel"};
  desk.window.palette_open = true;
  desk.frames();
  desk.type(Key::escape);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"palette"});
  desk.type(Key::escape);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer Cancel"});
}

TEST(Front, TabBeginsInThePanelThatWasShownLastWithoutAClick) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  for (const auto& [panel, title] : {std::pair{Key::f3, "Layers"}, {Key::f4, "Candidates"}, {Key::f3, "Layers"}}) {
    desk.type(panel);
    desk.frames();
    desk.type(Key::tab);
    desk.frames();
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    ASSERT_TRUE(imgui.NavWindow) << title;
    EXPECT_STREQ(imgui.NavWindow->Name, title);
    EXPECT_TRUE(imgui.IO.NavVisible && imgui.NavId != 0) << title << ": nobody sees where one is";
  }
}

TEST(Front, EnterPressesTheControlThatTabStandsOnAndDoesNothingElse) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  desk.type(Key::f3);
  desk.frames();
  desk.type(Key::enter);
  EXPECT_THAT(names(desk.frames()), IsEmpty()) << "none has the ring";
  desk.type(Key::tab);
  desk.frames();
  for (int i = 0; i < 2; ++i) {
    desk.type(Key::enter);
    EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"toggle-object"});
  }
}

TEST(Front, EnterInATextOfThePanelSetsItAndSpaceStepsThen) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  const auto all = seen_texts();
  const SeenText* const voxel = find_text(all, "40 mm", "Session");
  ASSERT_NE(voxel, nullptr) << read("Session");
  desk.click(voxel->from.x + 4, voxel->middle());
  desk.frames();
  desk.type_with(key('A'), true);
  desk.write("20");
  desk.frames();
  desk.type(Key::enter);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"set map.resolution 0.02"});
  desk.type(Key::space);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"step"});
}

TEST(Front, TheRingIsWhereItWasOnceWhatLayInFrontIsClosed) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  desk.type(Key::f3);
  desk.frames();
  desk.type(Key::tab);
  desk.frames();
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const ImGuiID control = imgui.NavId;
  for (const bool* open : {&desk.window.palette_open, &desk.window.shortcuts_open}) {
    open == &desk.window.palette_open ? desk.type_with(key('P'), true) : desk.type(Key::f1);
    desk.frames();
    ASSERT_TRUE(*open);
    desk.type(Key::escape);
    desk.frames();
    ASSERT_FALSE(*open);
    EXPECT_STREQ(imgui.NavWindow->Name, "Layers");
    EXPECT_TRUE(imgui.IO.NavVisible && imgui.NavId == control);
  }
}

TEST(Front, AfterAQuestionThatWasAnsweredByKeysSpaceSteps) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  desk.progress.question = "Take it?";
  desk.progress.answers = {"Take it", "Reject it"};
  desk.look();
  desk.type(Key::tab);
  desk.frames();
  desk.type(Key::enter);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"answer \"Take it\""});
  desk.progress = {};
  desk.frames();
  desk.type(Key::space);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"step"});
}

/// Who clicked a row and leaves it with Escape has shown no wish to go on by keys: Space steps.
TEST(Front, SpaceStepsAfterAClickAndEscape) {
  Desk desk;
  desk.snapshot = scanned(small_scan(), 2);
  desk.frames();
  const Rectangle right = desk.layout().right;
  desk.click(right.x + 60, right.y + 260);  // a row of the candidates
  desk.frames();
  desk.type(Key::escape);
  desk.frames();
  desk.type(Key::space);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"step"});
}

/// Letters that were meant for something else must not act on a session that is about to be replaced.
TEST(Front, WhileAnotherSessionIsOpenedNothingIsDoneToThisOne) {
  Desk desk;
  open_all_ways(desk);
  desk.progress.busy = desk.progress.opening = true;
  for (const char name : {'S', 'P', 'R', 'T', 'B', 'G'}) {
    desk.type(key(name));
    for (const CommandCall& call : desk.frames()) {
      CommandTarget target{desk.worker(), desk.window, *desk.snapshot, desk.progress};
      EXPECT_THROW(execute(call, target), std::invalid_argument) << name << ": " << call.text();
    }
  }
}

TEST(Front, EscapeClosesAListOfAPanel) {
  Desk desk;
  open_all_ways(desk);
  const Rectangle left = desk.layout().left;
  for (double y = left.y + 60; y < left.y + 120 && open_popups() == 0; y += 8) {
    desk.click(left.x + 160, y);  // gain, semantics, sensor
    desk.frames();
  }
  ASSERT_EQ(open_popups(), 1) << "no list opened";
  desk.type(key('S'));
  EXPECT_THAT(names(desk.frames()), IsEmpty());
  desk.type(Key::escape);
  EXPECT_THAT(names(desk.frames()), IsEmpty());
  EXPECT_EQ(open_popups(), 0);
}

TEST(Front, PaletteAndSheetAreClosedOneAfterTheOther) {
  Desk desk;
  open_all_ways(desk);
  desk.window.shortcuts_open = desk.window.palette_open = true;
  desk.frames();
  open_menu(desk);
  const Selection selected = desk.window.selection;
  desk.type(Key::escape);
  desk.frames();
  EXPECT_TRUE(desk.window.palette_open && desk.window.shortcuts_open && open_popups() == 0);
  desk.type(Key::escape);
  desk.frames();
  EXPECT_TRUE(!desk.window.palette_open && desk.window.shortcuts_open);
  desk.type(key('S'));
  EXPECT_THAT(names(desk.frames()), IsEmpty()) << "a shortcut behind the sheet";
  desk.type(Key::escape);
  desk.frames();
  EXPECT_FALSE(desk.window.shortcuts_open);
  EXPECT_EQ(desk.window.selection, selected);
}

/// The chooser is where one goes after an object could not be opened.
TEST(Front, AnObjectIsChosenWhenThereIsNone) {
  Desk desk;
  desk.frames();
  const Rectangle left = desk.layout().left;
  const double y = left.y + 32 + 10 + 12;
  for (double x = left.x + 150; x < left.x + left.width && open_popups() == 0; x += 6) {
    desk.click(x, y);
    desk.frames();
  }
  ASSERT_EQ(open_popups(), 1) << "the list of objects does not open";
  const ImRect list = ImGui::GetCurrentContext()->OpenPopupStack[0].Window->Rect();
  desk.click(list.Min.x + 20, list.Min.y + 16);
  EXPECT_EQ(names(desk.frames()), std::vector<std::string>{"open slotted_housing"});
}

}  // namespace
}  // namespace nextview
