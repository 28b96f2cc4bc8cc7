// A panel of one's own, in one file of tests/exercises and one line here; and what the program's own panels are.
#include <gmock/gmock.h>

#include "tests/exercises/note_panel.hpp"
#include "tests/unit/panels/desk.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

std::vector<PanelEntry> with_note() {
  std::vector<PanelEntry> panels = standard_panels();
  panels.push_back(note_panel());
  return panels;
}

TEST(OwnPanel, IsBroughtToTheFrontByItsNameAndDrawn) {
  Desk desk(1280, 800, 1.0, with_note());
  desk.frames();
  EXPECT_EQ(ImGui::FindWindowByName("Note"), nullptr) << "another one is in front";
  CommandTarget target{desk.worker(), desk.window, *desk.snapshot, desk.progress};
  execute(parse_call("panel note"), target);
  EXPECT_EQ(desk.window.in_front(Side::bottom), "note");
  desk.frames();
  const ImGuiWindow* note = ImGui::FindWindowByName("Note");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(read("Note"), testing::HasSubstr("Turn the part over"));
  EXPECT_TRUE(desk.layout().bottom.contains(note->Pos.x + 1, note->Pos.y + 1));
}

TEST(OwnPanel, HasATabAndAKey) {
  Desk desk(1280, 800, 1.0, with_note());
  desk.frames();
  desk.type(Key::f12);
  const auto calls = desk.frames();
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls.front().text(), "panel note");
  EXPECT_EQ(desk.window.in_front(Side::bottom), "note");
}

TEST(OwnPanel, IsUnknownWhereItIsNotOffered) {
  const Desk desk;
  try {
    parse_call("panel note");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("panel: PANEL must be one of session, layers, candidates, view"));
  }
}

TEST(StandardPanels, HaveNamesOfTheirOwnAndOneInFrontOfEachSide) {
  const Desk desk;
  std::set<std::string> names;
  for (const PanelEntry& panel : standard_panels()) {
    EXPECT_TRUE(names.insert(panel.info.name).second) << panel.info.name;
    EXPECT_TRUE(panel.info.help.ends_with(".")) << panel.info.name;
    EXPECT_NE(panel.make(), nullptr);
  }
  EXPECT_EQ(WindowState().in_front(Side::left), "session");
  EXPECT_EQ(WindowState().in_front(Side::right), "candidates");
  EXPECT_EQ(WindowState().in_front(Side::bottom), "curves");
  for (const std::string& name : {panel_name::view, panel_name::inspector, panel_name::gibbs, panel_name::curves})
    EXPECT_TRUE(names.contains(name)) << "commands bring it to the front";
}

}  // namespace
}  // namespace nextview
