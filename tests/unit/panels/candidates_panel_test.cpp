// What the table of candidates shows, in which order, and what clicks on it do.
#include <gmock/gmock.h>

#include <cctype>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

using testing::_;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CandidatesPanel : public testing::Test {
 protected:
  CandidatesPanel() { desk_.snapshot = scan_; }

  /// The lines of the table, as people read them.
  std::vector<std::string> rows() {
    desk_.frames();
    std::vector<std::string> rows;
    for (const std::string& line : read_lines("Candidates"))
      if (std::isdigit(static_cast<unsigned char>(line.front()))) rows.push_back(line);
    return rows;
  }
  /// Their numbers, from the uppermost.
  std::vector<int> order() {
    std::vector<int> numbers;
    for (const std::string& row : rows()) numbers.push_back(std::stoi(row));
    return numbers;
  }
  std::string panel() {
    desk_.frames();
    return read("Candidates");
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_;
};

TEST_F(CandidatesPanel, EachNumberStandsInItsColumnWithItsUnit) {
  EXPECT_THAT(rows(), ElementsAre("6 160 0.75 0.2000", "1 40 0.25 0.0500", "3 20 2.00 0.0200", "0 10 0.50 0.0100",
                                  "7 5 1.50 -0.0300", "4 80 1.00 -0.1000", "5 view 2", "2 not reachable"));
  EXPECT_THAT(panel(), HasSubstr("candidate gain [nats] cost [m] utility"));
  EXPECT_THAT(panel(), HasSubstr("ranked by occlusion-aware"));
  scan_->gain_unit = "";
  EXPECT_THAT(panel(), HasSubstr("candidate gain cost [m] utility"));
}

TEST(CandidatesPanelInASmallWindow, ItsButtonsAreInSight) {
  Desk desk(640, 480);
  desk.snapshot = made_scan();
  desk.frames();
  const auto all = seen_texts();
  for (const char* name : {"Take the selected", "Take the proposal"}) {
    const SeenText* const button = find_text(all, name, "Candidates");
    ASSERT_TRUE(button) << name;
    EXPECT_LT(button->to.y + 6, ImGui::FindWindowByName("Candidates")->InnerRect.Max.y) << name;
  }
}

TEST_F(CandidatesPanel, TheTableIsInSmallLettersAndTheButtonsAreNot) {
  desk_.frames();
  const auto all = seen_texts();
  const auto height = [&](const char* text) {
    const SeenText* found = find_text(all, text, "Candidates");
    return found ? found->to.y - found->from.y : 0;
  };
  EXPECT_GT(height("160"), 5);
  EXPECT_EQ(height("160"), height("gain [nats]"));
  EXPECT_EQ(height("160"), height("ranked by occlusion-aware"));
  EXPECT_GT(height("Take the proposal"), height("160"));
}

TEST_F(CandidatesPanel, WaysAroundASmallPartAreInMillimetres) {
  scan_->state.known.map = OccupancyMap(region_of_interest(Vector3::Zero(), 0.05, 0.001));
  for (Candidate& candidate : scan_->records.back().candidates) candidate.cost *= 0.01;
  EXPECT_THAT(panel(), HasSubstr("cost [mm]"));
  EXPECT_THAT(rows().front(), HasSubstr("160 7.5 0.2000"));
  for (Candidate& candidate : scan_->records.back().candidates) candidate.cost *= 10;
  EXPECT_THAT(rows().front(), HasSubstr("160 75 0.2000")) << "whole ones where they are long";
}

TEST_F(CandidatesPanel, GainsHaveAsManyDecimalsAsTheLargestHasDigitsLeft) {
  for (Candidate& candidate : scan_->records.back().candidates) candidate.gain *= 0.1251;  // 20.016 at most
  EXPECT_THAT(rows(), ElementsAre(HasSubstr(" 20.02 "), HasSubstr(" 5.00 "), HasSubstr(" 2.50 "), HasSubstr(" 1.25 "),
                                  HasSubstr(" 0.63 "), HasSubstr(" 10.01 "), _, _));
  for (Candidate& candidate : scan_->records.back().candidates) candidate.gain *= 1e-3;
  EXPECT_THAT(rows().front(), HasSubstr(" 0.02002 "));
}

TEST_F(CandidatesPanel, AreasHaveTheUnitOfTheSentenceAboveThem) {
  scan_->gain_unit = "cm²";
  EXPECT_THAT(panel(), HasSubstr("gain [cm²]"));
  for (Candidate& candidate : scan_->records.back().candidates) candidate.gain *= 100;  // 16,000 of the proposal
  EXPECT_THAT(panel(), HasSubstr("gain [m²]"));
  EXPECT_THAT(rows().front(), HasSubstr("6 1.600 "));
  for (Candidate& candidate : scan_->records.back().candidates) candidate.gain *= 1e-6;
  EXPECT_THAT(panel(), HasSubstr("gain [mm²]"));
}

TEST_F(CandidatesPanel, ALongUnitHasRoomInItsColumn) {
  scan_->gain_unit = "nats/voxel";
  desk_.frames();
  const auto all = seen_texts();
  const SeenText* const gain = find_text(all, "gain [nats/voxel]", "Candidates");
  const SeenText* const cost = find_text(all, "cost [m]", "Candidates");
  ASSERT_TRUE(gain && cost) << read("Candidates");
  EXPECT_LT(gain->to.x + 4, cost->from.x);
}

TEST_F(CandidatesPanel, TheFormulaHasTheWeightsOfThePlanner) {
  scan_->configuration.planner.weights = {1, 0.3};
  EXPECT_THAT(panel(), HasSubstr("U = gain share − 0.3 cost share (Eq. 13)"));
  scan_->configuration.planner.weights = {2, 1};
  EXPECT_THAT(panel(), HasSubstr("U = 2 gain share − cost share (Eq. 13)"));
}

TEST_F(CandidatesPanel, AClickOnAHeaderSortsAndAnotherTurnsItRound) {
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "cost [m]", "Candidates")), "sort cost ascending") << "near ones first";
  EXPECT_THAT(order(), ElementsAre(1, 0, 6, 4, 7, 3, 5, 2));
  EXPECT_EQ(text_of(click_on(desk_, "cost [m]", "Candidates")), "sort cost descending");
  EXPECT_THAT(order(), ElementsAre(3, 7, 4, 6, 0, 1, 2, 5));
  EXPECT_EQ(text_of(click_on(desk_, "gain [nats]", "Candidates")), "sort gain descending") << "good ones first";
  EXPECT_THAT(order(), ElementsAre(6, 4, 1, 3, 0, 7, 2, 5));
  EXPECT_EQ(text_of(click_on(desk_, "gain [nats]", "Candidates")), "sort gain ascending");
  EXPECT_THAT(order(), ElementsAre(7, 0, 3, 1, 4, 6, 5, 2));
  EXPECT_EQ(text_of(click_on(desk_, "candidate", "Candidates")), "sort view ascending");
  EXPECT_THAT(order(), ElementsAre(0, 1, 3, 4, 6, 7, 2, 5));
  EXPECT_EQ(text_of(click_on(desk_, "utility", "Candidates")), "sort utility descending");
  EXPECT_THAT(order(), ElementsAre(6, 1, 3, 0, 7, 4, 5, 2));
  EXPECT_EQ(text_of(click_on(desk_, "utility", "Candidates")), "sort utility ascending");
  EXPECT_THAT(order(), ElementsAre(4, 7, 0, 3, 1, 6, 2, 5));
}

/// The bar behind each number is as long as the number's share of the largest among the candidates that are left.
TEST_F(CandidatesPanel, BarsAreSharesOfTheLargestThatIsLeft) {
  desk_.frames();
  const auto texts = seen_texts();
  const auto expect_bar = [&](const std::string& number, const Colour& colour, double paleness, double share) {
    const SeenText* text = find_text(texts, number, "Candidates");
    ASSERT_NE(text, nullptr) << number;
    std::vector<ImRect> bars;
    for (const ImRect& area : seen_areas(mix(colour, theme::paper, paleness), "Candidates"))
      if (area.Min.y < text->middle() && text->middle() < area.Max.y && area.Min.x < text->to.x &&
          text->to.x - area.Min.x < 120)
        bars.push_back(area);
    ASSERT_EQ(bars.size(), 1u) << number;
    EXPECT_NEAR(bars[0].GetWidth(), share * (text->to.x - bars[0].Min.x), 1.6) << number;
  };
  expect_bar("160", theme::chosen, 0.7, 1);
  expect_bar("80", theme::series[0], 0.7, 0.5);
  expect_bar("40", theme::series[0], 0.7, 0.25);
  expect_bar("2.00", theme::muted, 0.7, 1);
  expect_bar("1.50", theme::muted, 0.7, 0.75);
  expect_bar("0.2000", theme::chosen, 0.7, 1);
  expect_bar("0.0500", theme::series[0], 0.7, 0.25);
  expect_bar("-0.1000", theme::series[0], 0.86, 0.5);
}

TEST_F(CandidatesPanel, SaysWhatIsNext) {
  EXPECT_THAT(panel(), HasSubstr("Next is the proposal, candidate 6."));
  scan_->next_candidate = 1;
  EXPECT_THAT(panel(), HasSubstr("Next is your choice, candidate 1; proposed was candidate 6."));
  scan_->next_candidate.reset();
  EXPECT_THAT(panel(), HasSubstr("No candidate is left."));
  scan_->custom_next_view = true;
  EXPECT_THAT(panel(), HasSubstr("Next is a custom view; proposed was candidate 6."));
  scan_->records[1].ranking.degenerate = "all are alike";
  EXPECT_THAT(panel(), HasSubstr("The ranking says little: all are alike."));
  scan_->finished = "enough";
  EXPECT_THAT(panel(), HasSubstr("The scan is finished."));
  EXPECT_THAT(panel(), Not(HasSubstr("says little")));
  desk_.snapshot = scanned(small_scan(), 0);
  EXPECT_THAT(panel(), HasSubstr("The first view is the start view"));
}

TEST_F(CandidatesPanel, ProposalAndNextViewStandOut) {
  scan_->next_candidate = 1;
  desk_.frames();
  std::map<std::string, ImU32> colours;
  for (const SeenText& t : seen_texts())
    if (t.window == "Candidates") colours.emplace(t.text, t.colour);
  EXPECT_EQ(colours.at("6"), to_imgui_u32(theme::chosen)) << "the proposal";
  EXPECT_EQ(colours.at("1"), to_imgui_u32(theme::chosen)) << "the next view";
  EXPECT_EQ(colours.at("3"), to_imgui_u32(theme::ink));
  EXPECT_EQ(colours.at("5"), to_imgui_u32(theme::soft_ink)) << "taken";
}

TEST_F(CandidatesPanel, AClickOnARowLooksAtTheCandidateAndAnotherAtTheNextView) {
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "0.0200", "Candidates")), "select-view 3");
  desk_.window.selection.view = {ViewSelection::Kind::candidate, 3};
  for (int i = 0; i < 60; ++i) desk_.frame();  // so that the next click is no double click
  EXPECT_EQ(text_of(click_on(desk_, "0.0200", "Candidates")), "select-next");
  EXPECT_THAT(panel(), HasSubstr("Take 3 next"));
  EXPECT_EQ(text_of(click_on(desk_, "Take 3 next", "Candidates")), "take-view");
}

TEST_F(CandidatesPanel, HasThreeRowsInTheSmallestWindow) {
  const auto scan = made_scan();
  scan->records[1].ranking.reason += " " + scan->records[1].ranking.reason;
  Desk desk(640, 480);
  desk.snapshot = scan;
  desk.frames();
  for (const char* utility : {"0.2000", "0.0500", "0.0200"})
    EXPECT_NE(find_text(seen_texts(), utility, "Candidates"), nullptr) << utility << ": " << read("Candidates");
}

}  // namespace
}  // namespace nextview
