// The settings as the Session panel shows and changes them.
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

class SessionPanelTest : public testing::Test {
 protected:
  SessionPanelTest() { desk_.snapshot = scan_; }
  std::string panel() {
    desk_.frames();
    return read("Session");
  }
  /// Writes into the field that shows this.
  std::string write_into(const std::string& shown, const std::string& text) {
    click_on(desk_, shown, "Session");
    desk_.type_with(key('A'), true);
    desk_.write(text);
    desk_.type(Key::enter);
    return text_of(desk_.frames());
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_;
};

TEST_F(SessionPanelTest, ShowsTheSettingsOfTheScan) {
  scan_->configuration.seed = 77;
  scan_->configuration.termination.views = 13;
  scan_->configuration.map.resolution = 0.0275;
  EXPECT_THAT(panel(), HasSubstr("Gain occlusion-aware"));
  EXPECT_THAT(panel(), HasSubstr("Voxel 27.5 mm"));
  EXPECT_THAT(panel(), HasSubstr("Views 13"));
  EXPECT_THAT(panel(), HasSubstr("Seed 77"));
}

TEST_F(SessionPanelTest, WhatIsWrittenIsSet) {
  scan_->configuration.seed = 77;
  scan_->configuration.map.resolution = 0.0275;
  desk_.frames();
  EXPECT_EQ(write_into("27.5 mm", "0.05 m"), "set map.resolution 0.05");
  EXPECT_EQ(write_into("77", "12"), "set seed 12");
}

/// A bare number is in the unit that the field shows, also where it shows metres.
TEST_F(SessionPanelTest, LengthsAreWrittenInAnyUnit) {
  scan_->configuration.map.resolution = 0.0275;
  desk_.frames();
  EXPECT_EQ(write_into("27.5 mm", "5"), "set map.resolution 0.005");
  EXPECT_EQ(write_into("27.5 mm", "5 mm"), "set map.resolution 0.005");
  EXPECT_EQ(write_into("27.5 mm", "1.2cm"), "set map.resolution 0.012");
  EXPECT_EQ(write_into("27.5 mm", "27.5"), "set map.resolution 0.0275");
}

/// The command says what is wrong; the field does not guess.
TEST_F(SessionPanelTest, WhatIsNotAllowedIsLeftToTheCommand) {
  scan_->configuration.map.resolution = 0.0275;
  scan_->configuration.termination.views = 13;
  desk_.frames();
  EXPECT_EQ(write_into("27.5 mm", "99 m"), "set map.resolution 99");
  EXPECT_EQ(write_into("27.5 mm", "five"), "set map.resolution five");
  EXPECT_EQ(write_into("13", "-5"), "set termination.views -5");
}

/// A window manager takes a title's height of the usual window.
TEST(SessionPanel, AllOfItIsInSightInTheUsualWindow) {
  for (const int height : {800, 770}) {
    Desk desk(1280, height);
    const auto scan = made_scan();
    scan->guessed_unit = "mm";
    desk.snapshot = scan;
    desk.frames();
    EXPECT_EQ(ImGui::FindWindowByName("Session")->ScrollMax.y, 0) << height;
  }
}

/// A name that is long with its unit has a line of its own above the field, a short one stands beside it.
TEST_F(SessionPanelTest, AllOthersAreInGroupsThatOpen) {
  desk_.frames();
  click_on(desk_, "Gibbs sampler", "Session");
  desk_.frames();
  const std::vector<std::string> lines = read_lines("Session");
  EXPECT_THAT(lines, testing::Contains("angular sigma [rad]"));
  EXPECT_THAT(lines, testing::Contains("voxel range segment"));
}

TEST(SessionPanelFields, CoverNoName) {
  Desk desk(1280, 3600);
  desk.snapshot = made_scan();
  desk.frames();
  for (const char* group : {"Evaluation", "Termination", "Gibbs sampler", "Planner", "Candidate views", "Map", "Cloud",
                            "Sensor", "Object"}) {  // from below, as each moves those beneath it
    const auto all = seen_texts();
    const SeenText* title = nullptr;
    for (const SeenText& text : all)
      if (text.window == "Session" && text.text == group) title = &text;  // the last one: fields are called so, too
    ASSERT_NE(title, nullptr) << group;
    desk.click(title->from.x + 2, title->middle());
    desk.frames();
  }
  const auto all = seen_texts();
  const float fields = float(desk.layout().left.x) + 92;
  std::size_t names = 0;
  for (const SeenText& name : all) {
    if (name.window != "Session" || name.from.x >= fields) continue;
    ++names;
    const auto is_its_value = [&](const SeenText& value) {
      return value.window == "Session" && value.from.x >= fields && std::abs(value.middle() - name.middle()) < 4;
    };
    EXPECT_TRUE(name.to.x <= fields || std::ranges::none_of(all, is_its_value)) << name.text;
  }
  EXPECT_GT(names, 60u);
}

/// That once threw out of the frame.
TEST(SessionPanelFields, ATextCanBeCleared) {
  Desk desk(1280, 3600);  // the whole group is in sight
  const auto scan = made_scan();
  scan->configuration.planner.combined_weights = "area-factor=3";
  desk.snapshot = scan;
  desk.frames();
  click_on(desk, "Planner", "Session");
  desk.frames();
  const auto all = seen_texts();
  const auto shown = std::ranges::find_if(all, [](const SeenText& t) { return t.text.ends_with("area-factor=3"); });
  ASSERT_NE(shown, all.end()) << read("Session");
  desk.click(shown->to.x - 4, shown->middle());
  desk.frames();
  desk.type_with(key('A'), true);
  desk.type(Key::backspace);
  desk.type(Key::enter);
  EXPECT_EQ(text_of(desk.frames()), "set planner.combined_weights \"\"");
}

TEST_F(SessionPanelTest, AChoiceIsSetToo) {
  desk_.frames();
  click_on(desk_, "occlusion-aware", "Session");
  EXPECT_EQ(text_of(click_on(desk_, "rear-side-voxel")), "set planner.gain rear-side-voxel");
}

/// Some settings stand above the groups, too.
TEST_F(SessionPanelTest, AListIsAsLongWhereItsGroupIsOpen) {
  const auto list_height = [&](bool group_is_open) {
    Desk desk;
    desk.snapshot = scan_;
    desk.frames();
    if (group_is_open) click_on(desk, "Planner", "Session");
    click_on(desk, "occlusion-aware", "Session");
    desk.frames();
    const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
    return open.empty() ? 0.0f : open.back().Window->ContentSize.y;
  };
  const float alone = list_height(false);
  EXPECT_GT(alone, 0);
  EXPECT_NEAR(list_height(true), alone, 0.1 * alone);
}

TEST_F(SessionPanelTest, ASizeSaysThatItsUnitWasGuessed) {
  EXPECT_THAT(panel(), testing::Not(HasSubstr("unit guessed")));
  scan_->guessed_unit = "mm";
  EXPECT_THAT(panel(), HasSubstr("500 x 500 x 500 mm; unit guessed: mm"));
}

/// Nobody takes it for a length that was rounded away.
TEST_F(SessionPanelTest, ALongestSideThatIsNotSetIsItsOwn) {
  desk_.frames();
  for (const SeenText& seen : seen_texts())  // the last one is the group's
    if (seen.text == "Object") desk_.click(seen.from.x, seen.middle());
  EXPECT_THAT(panel(), HasSubstr("0 m: its own"));
}

/// Another scan's settings take the place of those that were shown.
TEST_F(SessionPanelTest, FollowsTheScan) {
  desk_.frames();
  auto other = std::make_shared<SessionSnapshot>(*scan_);
  other->configuration.planner.gain = "average-entropy";
  desk_.snapshot = other;
  EXPECT_THAT(panel(), HasSubstr("Gain average-entro"));
}

}  // namespace
}  // namespace nextview
