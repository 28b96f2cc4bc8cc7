// What the View panel says of a view: its pictures' words, its numbers, its rays.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;
using Kind = ViewSelection::Kind;

class ViewPanel : public testing::Test {
 protected:
  ViewPanel() {
    desk_.snapshot = scan_;
    desk_.window.bring_to_front(panel_name::view);
  }

  /// What is expected of a view, or what it measured: 4 x 3 cells.
  void show_view(ViewSelection view, std::vector<float> measured = {}) {
    desk_.window.selection.view = view;
    ViewInspection inspected;
    inspected.view = view;
    inspected.expected = {4, 3, std::vector<float>(12, -1.0f), std::vector<std::uint8_t>(12, 0)};
    inspected.expected.depth[0] = 0.25f;
    inspected.expected.depth[6] = 1.5f;
    inspected.expected.unknown[6] = 1;
    inspected.measured = std::move(measured);
    if (inspected.measured.empty()) {
      ScoreExplanation e;
      e.rays.resize(48);
      for (std::size_t i = 0; i < 48; ++i) e.rays[i].contribution = 0.5 + double(i);
      e.value = 1234.25;
      inspected.explanation = std::make_shared<const ScoreExplanation>(e);
    } else {
      inspected.no_explanation = "it has been taken";
    }
    desk_.inspection.view = inspected;
  }
  std::string panel() {
    desk_.frames();
    return read("View");
  }
  /// Where the picture at the left of these words begins.
  ImVec2 picture_beside(const std::string& words) {
    desk_.frames();
    const auto all = seen_texts();
    const SeenText* text = find_text(all, words, "View");
    if (!text) {
      ADD_FAILURE() << words << " is not in: " << read("View");
      return {};
    }
    return {text->from.x - 206, text->from.y};
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_;
};

TEST_F(ViewPanel, ACandidatesNumbersAreThoseOfTheRanking) {
  show_view({Kind::candidate, 3});
  EXPECT_THAT(panel(), HasSubstr("expected gain 1234 nats in the ranking 20 nats way there 2 m utility 0.0200"));
  EXPECT_THAT(panel(), HasSubstr("Candidate 3"));
  show_view({});
  EXPECT_THAT(panel(), HasSubstr("in the ranking 160 nats way there 0.75 m utility 0.2000")) << "of the next view";
  EXPECT_THAT(panel(), HasSubstr("Next: candidate 6"));
  show_view({Kind::candidate, 5});
  EXPECT_THAT(panel(), HasSubstr("taken"));
  EXPECT_THAT(panel(), Not(HasSubstr("8888"))) << "a gain that is left over";
}

TEST_F(ViewPanel, AGainByFewerRaysThanExplainItSaysSo) {
  scan_->configuration.planner.ray_columns = 4, scan_->configuration.planner.ray_rows = 3;
  show_view({Kind::candidate, 3});
  EXPECT_THAT(panel(), HasSubstr("expected gain 1234 nats in the ranking 20 nats by 12 rays way there"));
  EXPECT_THAT(panel(), HasSubstr("What each of its 48 rays adds"));
  scan_->records.back().candidates[3].gain = 1234.25;  // one of the best: by as many
  EXPECT_THAT(panel(), HasSubstr("in the ranking 1234 nats way there"));
}

TEST_F(ViewPanel, ATakenViewsNumbersAreThoseOfItsRecord) {
  show_view({Kind::taken, 1}, std::vector<float>(12, 0.5f));
  EXPECT_THAT(panel(), HasSubstr("View 2 as taken"));
  EXPECT_THAT(
      panel(),
      HasSubstr("taken from candidate 5 predicted 12.5 nats new surface 214 cm² realised 321 nats new voxels 77 "
                "points 500 of 600 hits beyond range 40 rays way there 1.25 m, 90°"));
  scan_->records[1].overridden = true;
  EXPECT_THAT(panel(), HasSubstr("taken from candidate 5, your choice"));
  scan_->records[1].view = -1;
  EXPECT_THAT(panel(), HasSubstr("taken from your custom view predicted 12.5 nats"));
  scan_->records[1].overridden = false;
  EXPECT_THAT(panel(), HasSubstr("taken from the start view predicted none new surface 214 cm² realised 321 nats"));
  scan_->gain_unit = "cm²";  // then both are surface
  EXPECT_THAT(panel(), HasSubstr("new surface 214 cm² realised 321 nats")) << "it was chosen by a gain in nats";
  scan_->records[1].gain_unit = "";
  EXPECT_THAT(panel(), HasSubstr("predicted none realised 214 cm² entropy lost 321 nats"));
}

TEST_F(ViewPanel, DepthsAreInMillimetres) {
  show_view({});
  EXPECT_THAT(panel(), HasSubstr("Dark 250 mm, pale 1500 mm; white: nothing."));
  const ImVec2 corner = picture_beside("Depth as the");
  const float cell = 196.0f / 4;
  desk_.move(corner.x + 0.5 * cell, corner.y + 0.5 * cell);
  desk_.frames();
  EXPECT_EQ(read_tooltip(), "250 mm");
  desk_.move(corner.x + 2.5 * cell, corner.y + 1.5 * cell);
  desk_.frames();
  EXPECT_EQ(read_tooltip(), "1500 mm the way there is not known");
  desk_.move(corner.x + 1.5 * cell, corner.y + 0.5 * cell);
  desk_.frames();
  EXPECT_EQ(read_tooltip(), "nothing met");
  std::vector<float> measured(12, -1.0f);
  measured[5] = 0.75f;
  show_view({Kind::taken, 1}, measured);
  EXPECT_THAT(panel(), HasSubstr("Depth as measured."));
  const ImVec2 taken = picture_beside("Depth as");
  desk_.move(taken.x + 1.5 * cell, taken.y + 1.5 * cell);
  desk_.frames();
  EXPECT_EQ(read_tooltip(), "750 mm") << "what was measured, not what the map has";
}

TEST_F(ViewPanel, EachCellOfTheLowerPictureIsItsRay) {
  show_view({});
  EXPECT_THAT(panel(), HasSubstr("What each of its 48 rays adds to the gain."));
  EXPECT_THAT(panel(), HasSubstr("Dark 47.5 nats, pale little"));
  const ImVec2 corner = picture_beside("What each");
  const float width = 196.0f / 8, height = 147.0f / 6;  // 8 x 6 rays; the camera has 80 x 60 pixels
  for (const auto& [column, row] : {std::pair{0, 0}, {5, 1}, {7, 5}, {2, 4}}) {
    desk_.click(corner.x + (column + 0.5) * width, corner.y + (row + 0.5) * height);
    const int ray = row * 8 + column;
    EXPECT_EQ(text_of(desk_.frames()), "inspect-ray " + std::to_string(ray));
    EXPECT_EQ(read_tooltip(), fmt::format("ray {}: {:g} nats", ray, 0.5 + ray));
  }
}

TEST_F(ViewPanel, TheButtonsAreThoseOfTheViewThatIsLookedAt) {
  show_view({});
  EXPECT_THAT(panel(), Not(HasSubstr("Take ")));
  show_view({Kind::candidate, 3});
  EXPECT_THAT(panel(), HasSubstr("Take this view next"));
  EXPECT_EQ(text_of(click_on(desk_, "Take this view next")), "take-view");
  EXPECT_EQ(text_of(click_on(desk_, "Look through it")), "look-through");
  desk_.window.selection.custom_view = Pose::Identity();
  show_view({Kind::custom, 0});
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Take the custom view next")), "take-custom-view");
}

TEST_F(ViewPanel, AViewIsNeverShownWithTheNumbersOfAnother) {
  show_view({Kind::candidate, 3});
  desk_.window.selection.view = {Kind::candidate, 4};
  EXPECT_THAT(panel(), HasSubstr("Candidate 4"));
  EXPECT_THAT(panel(), HasSubstr("Looking …"));
  EXPECT_THAT(panel(), Not(HasSubstr("gain")));
  scan_->finished = "enough";
  show_view({});
  EXPECT_THAT(panel(), HasSubstr("The scan is finished: there is no next view."));
}

TEST_F(ViewPanel, TheListHasTheNextTheTakenAndTheCandidatesThatAreLeft) {
  show_view({});
  desk_.frames();
  click_on(desk_, "Next: candidate 6", "View");
  const std::string all = read();
  for (const char* entry : {"The next view", "View 2 as taken", "View 1 as taken", "Candidate 0", "Candidate 7"})
    EXPECT_THAT(all, HasSubstr(entry));
  EXPECT_THAT(all, Not(HasSubstr("Candidate 5"))) << "taken";
  EXPECT_THAT(all, Not(HasSubstr("Candidate 2"))) << "out of reach";
  EXPECT_EQ(text_of(click_on(desk_, "View 2 as taken")), "select-taken 2");
}

}  // namespace
}  // namespace nextview
