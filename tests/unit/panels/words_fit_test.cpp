// Every panel, dialog and menu in every state, at three sizes: no word lies on another, and none is cut off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/panels/scan_states.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {
namespace {

/// So much may be common to two words' boxes: letters are lower than their lines [px].
constexpr float slack = 3.0f;

std::string place(const SeenText& t) {
  return fmt::format("{}: '{}' at {:.0f}, {:.0f}", t.window, t.text, t.from.x, t.from.y);
}

/// It, or a part of it.
bool scrolls_sideways(const std::string& name) {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    const std::string own = window->Name;
    if (window->WasActive && window->ScrollMax.x > 0 && own.substr(0, own.find('/')) == name) return true;
  }
  return false;
}

void expect_words_fit(int width, int height) {
  const std::vector<SeenText> all = seen_texts();
  EXPECT_GT(all.size(), 10u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_TRUE(all[i].from.x >= -1 && all[i].to.x <= float(width) + 1 && all[i].to.y <= float(height) + slack)
        << place(all[i]) << " is outside of the window";
    for (std::size_t k = 0; k < i; ++k) {
      const float right = std::min(all[i].to.x, all[k].to.x), left = std::max(all[i].from.x, all[k].from.x);
      const float low = std::min(all[i].to.y, all[k].to.y), high = std::max(all[i].from.y, all[k].from.y);
      if (all[i].window != all[k].window) continue;  // one above the other, of which the upper one hides the lower
      EXPECT_FALSE(right - left > 1 && low - high > 2 * slack) << place(all[i]) << " lies on " << place(all[k]);
    }
  }
  for (const SeenText& cut : cut_texts()) {
    EXPECT_TRUE(scrolls_sideways(cut.window)) << place(cut) << " is cut off";
  }
}

class WordsFit : public testing::TestWithParam<std::tuple<int, int, double>> {
 protected:
  void expect_fit(Desk& desk) {
    desk.frames();
    const auto [width, height, scale] = GetParam();
    expect_words_fit(width, height);
  }
};

TEST_P(WordsFit, InEveryPanel) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  Inspector inspector;
  for (const State& state : states()) {
    desk.snapshot = state.snapshot();
    Selection selection;
    if (!desk.snapshot->records.empty()) selection.voxel = 500;
    desk.inspection = inspector.inspect(desk.snapshot, selection);  // the same, whichever panel is in front
    for (const std::string& panel : panel_names()) {
      SCOPED_TRACE(std::string(state.name) + ", panel " + panel);
      desk.window = {};
      desk.window.guide_open = false;
      desk.window.bring_to_front(panel);
      desk.window.layers.section = Section{0, 0.0, false};
      desk.window.layers.surface = true;
      desk.window.selection = selection;
      expect_fit(desk);
    }
  }
}

TEST_P(WordsFit, InWhatOpensAboveThem) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  desk.snapshot = states()[1].snapshot();
  expect_fit(desk);  // the first steps
  for (const auto& open : std::vector<std::function<void(WindowState&)>>{
           [](WindowState& w) { w.shortcuts_open = true; }, [](WindowState& w) { w.palette_open = true; },
           [](WindowState& w) { w.file_for = "open"; }, [](WindowState& w) { w.file_for = "export"; },
           [](WindowState& w) { w.manual = "start"; }}) {
    desk.window = {};
    open(desk.window);
    expect_fit(desk);
  }
  desk.window = {};
  for (const WorkerProgress& progress : all_progress()) {
    desk.progress = progress;
    expect_fit(desk);
  }
}

TEST_P(WordsFit, InTheListOfCommandsWhateverIsFound) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  desk.snapshot = states()[1].snapshot();
  for (const Command& command : commands()) {
    desk.window = {};
    desk.frames();
    desk.window.palette_open = true;
    desk.window.palette_text = command.text;
    SCOPED_TRACE(command.name);
    expect_fit(desk);
  }
}

TEST_P(WordsFit, InEveryMenu) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  open_all_ways(desk);
  std::set<const ImGuiWindow*> seen;
  for (double x = 12 * scale; x < width; x += 20 * scale) {
    desk.click(x, desk.layout().menu.height / 2);
    desk.frames();
    const auto& stack = ImGui::GetCurrentContext()->OpenPopupStack;
    if (stack.Size > 0) seen.insert(stack[0].Window);
    expect_fit(desk);
    desk.type(Key::escape);
    desk.frames();
  }
  EXPECT_GE(seen.size(), 1u);
}

TEST(Menus, AreAllReachedHoweverLargeTextIs) {
  for (const double scale : {1.0, 1.5, 1.9}) {
    Desk desk(640, 480, scale);
    desk.frames();
    std::string seen = read("Menu");
    EXPECT_EQ(seen.find("More") == seen.npos, scale == 1.0) << scale;
    if (scale > 1.0) {
      click_on(desk, "More", "Menu");
      desk.frames();
      seen = read();
    }
    for (const std::string& menu : menus()) EXPECT_THAT(seen, testing::HasSubstr(menu)) << scale;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, WordsFit,
                         testing::Values(std::tuple(640, 480, 1.0), std::tuple(1280, 800, 1.0),
                                         std::tuple(1280, 800, Layout::largest_scale(1280, 800)),
                                         std::tuple(3840, 2160, 2.0)));

}  // namespace
}  // namespace nextview
