// The manual in the window.
#include <gmock/gmock.h>

#include "tests/unit/panels/desk.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/script.hpp"
#include "ui/manual/manual.hpp"

namespace nextview {
namespace {

void open_at(Desk& desk, const std::string& topic) {
  CommandTarget target{desk.worker(), desk.window, *desk.snapshot, desk.progress};
  execute(parse_call("manual " + topic), target);
  desk.frames();
}

TEST(ManualSheet, OpensAtAPageAndClosesByEscape) {
  Desk desk;
  open_at(desk, "planning");
  ASSERT_NE(ImGui::FindWindowByName("Manual"), nullptr);
  EXPECT_EQ(desk.window.manual, "planning");
  desk.type(Key::escape);
  desk.frames();
  EXPECT_FALSE(desk.window.manual);
  open_at(desk, "");
  EXPECT_EQ(desk.window.manual, manual_topics().front());
}

TEST(ManualSheet, EveryPageIsDrawnAtAnySizeOfTheWindow) {
  for (const auto& [width, height] : {std::pair{1280, 800}, {480, 360}}) {
    Desk desk(width, height);
    for (const std::string& topic : manual_topics()) {
      open_at(desk, topic);
      const ImGuiWindow* sheet = ImGui::FindWindowByName("Manual");
      ASSERT_NE(sheet, nullptr);
      EXPECT_LE(sheet->Pos.y + sheet->Size.y, float(height)) << topic;
      EXPECT_LE(sheet->Pos.x + sheet->Size.x, float(width)) << topic;
    }
  }
}

TEST(ManualSheet, NoOtherKeyDoesAnythingBehindIt) {
  Desk desk;
  open_at(desk, "start");
  desk.type(Key::space);
  for (const CommandCall& call : desk.frames()) EXPECT_EQ(call.command->name, "manual");
  EXPECT_THROW(open_at(desk, "planing"), std::invalid_argument) << "it is to name the topics";
}

}  // namespace
}  // namespace nextview
