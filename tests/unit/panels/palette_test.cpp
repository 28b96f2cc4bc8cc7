// The palette by keyboard alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/panels/seen.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/panels/palette_search.hpp"

namespace nextview {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> texts(const std::vector<CommandCall>& calls) {
  std::vector<std::string> texts;
  for (const CommandCall& call : calls) texts.push_back(call.text());
  return texts;
}

/// The palette with a text in it.
struct OpenPalette : Desk {
  explicit OpenPalette(const std::string& text) {
    open_all_ways(*this);
    window.palette_open = true;
    window.palette_text = text;
    frames();
  }
};

TEST(Palette, TabCompletesTheValueThatBeginsWithWhatWasTyped) {
  OpenPalette desk("set planner.gai");
  desk.type(Key::tab);
  EXPECT_THAT(desk.frames(), IsEmpty());
  desk.write("random");
  desk.frames();
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "set planner.gain random"));
}

/// By the words that other programs use, too.
TEST(Palette, FindsWhatPeopleCallOtherwise) {
  for (const auto& [typed, meant] : {std::pair{"resolution", "set map.resolution "},
                                     {"preferences", "set "},
                                     {"settings", "set "},
                                     {"save scan", "export "},
                                     {"font", "text-size "},
                                     {"text size", "text-size "},
                                     {"dark", "dark"},
                                     {"undo", "undo"},
                                     {"export", "export "},
                                     {"quit", "quit"},
                                     {"exit", "quit"},
                                     {"voxel size", "set map.resolution "},
                                     {"accuracy", "set sensor.range_noise "},
                                     {"standard deviation ray", "set sensor.range_noise "}}) {
    const std::vector<PaletteEntry> found = found_in_palette(typed);
    ASSERT_FALSE(found.empty()) << typed;
    EXPECT_EQ(found.front().written(), meant) << typed;
  }
  EXPECT_EQ(found_in_palette("").size(), commands().size()) << "settings are many, and nothing was asked for";
}

/// Menus show it, and it may begin as the name of another command does.
TEST(Palette, FindsACommandByItsTextInTheMenus) {
  for (const auto& [typed, done] : {std::pair{"refine the map", "refine"}, {"dark mode", "dark"}}) {
    OpenPalette desk(typed);
    desk.type(Key::enter);
    EXPECT_THAT(texts(desk.frames()), testing::Contains(done)) << typed;
  }
  OpenPalette desk("export a surface");
  desk.type(Key::enter);
  EXPECT_THAT(desk.frames(), IsEmpty()) << "where to is still to be said";
  EXPECT_NE(find_text(seen_texts(), "export-surface FILE [OF] [PART]", "Commands"), nullptr);
}

/// The key is written, and what it is and has been is seen beside its new value.
TEST(Palette, ASettingThatIsFoundIsChanged) {
  OpenPalette desk("ray refinement");
  desk.type(Key::enter);
  EXPECT_THAT(desk.frames(), IsEmpty());
  EXPECT_THAT(read("Commands"), ::testing::HasSubstr("; now 4"));
  desk.write("8");
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "set planner.ray_refinement 8"));
}

/// What the list shows as chosen was not what Enter did.
TEST(Palette, EnterTakesTheValueThatIsShownAsChosen) {
  OpenPalette desk("second-view ");
  desk.type(Key::enter);
  EXPECT_THAT(desk.frames(), IsEmpty()) << "the text has it now";
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "second-view none"));
}

TEST(Palette, TabCompletesTheCommand) {
  OpenPalette desk("reset-setti");
  desk.type(Key::down);  // past reset-setting
  desk.frames();
  desk.type(Key::tab);
  EXPECT_THAT(desk.frames(), IsEmpty());
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "reset-settings"));
}

TEST(Palette, EnterTakesTheValueThatArrowsChose) {
  OpenPalette desk("panel ");
  desk.type(Key::down);
  desk.frames();
  desk.type(Key::up);
  desk.frames();
  desk.type(Key::enter);
  EXPECT_THAT(desk.frames(), IsEmpty()) << "the text has it now";
  desk.type(Key::enter);
  const std::vector<std::string> done = texts(desk.frames());
  ASSERT_EQ(done.size(), 2u);
  EXPECT_THAT(done.back(), ::testing::StartsWith("panel "));
}

TEST(Palette, WhatIsWrongCanBeMendedAfterEnter) {
  for (const auto& [begun, better] : {std::pair{"undox", "undo"}, {"select-view x", "select-view 0"}}) {
    OpenPalette desk(begun);
    desk.type(Key::enter);
    EXPECT_THAT(desk.frames(), IsEmpty());
    desk.type(Key::backspace);
    if (better != std::string("undo")) desk.write("0");
    desk.frames();
    desk.type(Key::enter);
    EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", better));
  }
}

TEST(Palette, EnterRunsWhatWasTypedWhileNoValueIsChosen) {
  OpenPalette desk("set seed 7");
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "set seed 7"));
}

TEST(Palette, ALengthNeedsItsUnit) {
  OpenPalette desk("set map.resolution 5");
  desk.type(Key::enter);
  EXPECT_THAT(desk.frames(), IsEmpty()) << "metres for a script, millimetres for the field";
  desk.write("mm");
  desk.frames();
  desk.type(Key::enter);
  EXPECT_THAT(texts(desk.frames()), ElementsAre("palette", "set map.resolution 5mm"));
}

}  // namespace
}  // namespace nextview
