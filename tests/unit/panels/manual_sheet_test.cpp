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

TEST(ManualSheet, FindsPagesHeadingsAndTextAndGoesFromHitToHit) {
  Desk desk;
  open_at(desk, "start");
  click_on(desk, "Search", "Manual");
  desk.write("TERMINATION.surface_left");
  desk.frames();
  EXPECT_THAT(read(), testing::HasSubstr("Enter: the first"));
  EXPECT_EQ(desk.window.manual, "start") << "nothing is turned over while one writes";
  std::set<std::string> pages;
  for (int k = 0; k < 8; ++k) {
    desk.type(Key::enter);
    desk.frames();
    pages.insert(*desk.window.manual);
  }
  EXPECT_GT(pages.size(), 1u);
  EXPECT_TRUE(pages.contains("settings")) << testing::PrintToString(pages);
  desk.write("zzz");
  desk.frames();
  EXPECT_THAT(read(), testing::HasSubstr("does not say this"));
}

TEST(ManualSheet, WhoOpensItMaySearchAtOnce) {
  Desk desk;
  open_at(desk, "start");
  desk.write("termination");
  desk.frames();
  EXPECT_THAT(read(), testing::HasSubstr("Enter: the first"));
}

TEST(ManualSheet, ALinkOpensItsPage) {
  Desk desk;
  open_at(desk, "start");
  const ParsedPage page{read_manual_page("start"), parse_markdown(read_manual_page("start").text)};
  ASSERT_FALSE(page.blocks.empty());
  const auto all = seen_texts();
  const auto link = std::ranges::find_if(page.blocks, [](const MarkdownBlock& b) {
    return b.kind == MarkdownBlock::Kind::paragraph && !b.links.empty() && b.links.front().target.ends_with(".md");
  });
  ASSERT_NE(link, page.blocks.end());
  const MarkdownLink& first = link->links.front();
  click_on(desk, link->text.substr(first.begin, first.end - first.begin));
  EXPECT_EQ(*desk.window.manual + ".md", first.target);
}

TEST(ManualSheet, HeadingsAreFoundFirst) {
  const std::vector<ParsedPage> pages{
      {{"a", "A", ""}, parse_markdown("# A\n\nOf the noise there is much to say here.\n")},
      {{"b", "B", ""}, parse_markdown("# B\n\nLess of noise.\n\n## Noise\n\n| noise | x |\n|---|---|\n| 1 | 2 |\n")}};
  std::vector<std::string> found;
  for (const ManualHit& hit : find_in_manual(pages, "noise")) found.push_back(pages[hit.page].page.topic + hit.excerpt);
  EXPECT_THAT(found, testing::ElementsAre("bNoise", "bLess of noise.", "bnoise  x",
                                          "aOf the noise there is much to say here."));
  EXPECT_TRUE(find_in_manual(pages, "").empty());
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
