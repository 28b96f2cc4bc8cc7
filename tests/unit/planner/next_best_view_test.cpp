#include "core/planner/next_best_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nextview {
namespace {

std::vector<Candidate> candidates(std::vector<std::pair<double, double>> gains_and_costs) {
  std::vector<Candidate> result;
  for (const auto& [gain, cost] : gains_and_costs) result.push_back({true, gain, cost, 0.0});
  return result;
}

TEST(Rank, IsEquation13ByHand) {
  // Totals 10 and 4: 1/10 - 2/4, 3/10 - 1/4, 6/10 - 1/4.
  auto c = candidates({{1, 2}, {3, 1}, {6, 1}});
  const Ranking ranking = rank(c, {1.0, 1.0});
  EXPECT_NEAR(c[0].utility, -0.4, 1e-12);
  EXPECT_NEAR(c[1].utility, 0.05, 1e-12);
  EXPECT_NEAR(c[2].utility, 0.35, 1e-12);
  EXPECT_EQ(ranking.best, 2u);
  EXPECT_EQ(ranking.degenerate, "");
}

TEST(Rank, WeightsScaleTheTwoTerms) {
  auto c = candidates({{1, 2}, {3, 1}, {6, 5}});  // totals 10 and 8
  EXPECT_EQ(rank(c, {2.0, 0.5}).best, 2u);
  EXPECT_NEAR(c[0].utility, 0.2 - 0.125, 1e-12);
  EXPECT_NEAR(c[1].utility, 0.6 - 0.0625, 1e-12);
  EXPECT_NEAR(c[2].utility, 1.2 - 0.3125, 1e-12);
  EXPECT_EQ(rank(c, {0.1, 3.0}).best, 1u);
  EXPECT_EQ(rank(c, {1.0, 0.0}).best, 2u);
}

TEST(Rank, PerSecondIsTheGainOverTheTimeItTakes) {
  auto c = candidates({{10, 2}, {30, 1}, {60, 5}});
  c[0].seconds = 0.5, c[1].seconds = 1.0, c[2].seconds = 10.0;
  EXPECT_EQ(rank(c, {{1.0, 9.0}, 2.0}).best, 1u);
  EXPECT_NEAR(c[0].utility, 4.0, 1e-12);
  EXPECT_NEAR(c[1].utility, 10.0, 1e-12);
  EXPECT_NEAR(c[2].utility, 5.0, 1e-12);
}

TEST(Rank, SumsGoOverTheAvailableAlone) {
  auto c = candidates({{1, 2}, {100, 50}, {3, 2}});
  c[1].available = false;
  c[1].utility = 77.0;
  EXPECT_EQ(rank(c, {1.0, 1.0}).best, 2u);
  EXPECT_NEAR(c[0].utility, 0.25 - 0.5, 1e-12);
  EXPECT_NEAR(c[2].utility, 0.75 - 0.5, 1e-12);
}

TEST(Rank, AmongThoseThatOverlapIfThereAreAny) {
  auto c = candidates({{1, 1}, {9, 1}, {2, 1}, {8, 1}});
  c[1].overlaps = c[3].overlaps = false;
  EXPECT_EQ(rank(c, {1.0, 1.0}).best, 2u);
  EXPECT_EQ(runner_up(c, 2), 0u);
  c[0].overlaps = c[2].overlaps = false;
  EXPECT_EQ(rank(c, {1.0, 1.0}).best, 1u);
  EXPECT_EQ(runner_up(c, 1), 3u);
}

TEST(Rank, ATermWithoutASumIsZero) {
  auto no_cost = candidates({{1, 0}, {3, 0}});
  EXPECT_EQ(rank(no_cost, {1.0, 1.0}).best, 1u);
  EXPECT_NEAR(no_cost[1].utility, 0.75, 1e-12);
  auto no_gain = candidates({{0, 3}, {0, 1}});
  EXPECT_EQ(rank(no_gain, {1.0, 1.0}).best, 1u);
  EXPECT_NEAR(no_gain[1].utility, -0.25, 1e-12);
  auto nothing = candidates({{0, 0}, {0, 0}});
  EXPECT_EQ(rank(nothing, {1.0, 1.0}).best, 0u);
  for (const Candidate& c : nothing) EXPECT_EQ(c.utility, 0.0);
}

TEST(Rank, TiesGoToTheFirst) {
  auto c = candidates({{1, 1}, {4, 1}, {4, 1}, {4, 1}});
  EXPECT_EQ(rank(c, {1.0, 1.0}).best, 1u);
  c[1].available = false;
  EXPECT_EQ(rank(c, {1.0, 1.0}).best, 2u);
  auto all_alike = candidates({{2, 2}, {2, 2}, {2, 2}});
  EXPECT_EQ(rank(all_alike, {1.0, 1.0}).best, 0u);
}

TEST(Rank, NothingAvailableIsNoView) {
  std::vector<Candidate> none;
  EXPECT_FALSE(rank(none, {}).best);
  auto all_taken = candidates({{1, 2}, {3, 4}});
  for (Candidate& c : all_taken) c.available = false;
  EXPECT_FALSE(rank(all_taken, {}).best);
}

TEST(Rank, SaysWhyGainsDoNotTellCandidatesApart) {
  auto zero = candidates({{0, 1}, {0, 2}, {0, 3}});
  auto alike = candidates({{5, 1}, {5, 2}, {5, 3}});
  auto nearly_alike = candidates({{5, 1}, {5 + 1e-14, 2}, {5, 3}});
  auto apart = candidates({{5, 1}, {5.1, 2}, {5, 3}});
  auto hidden_by_what_is_taken = candidates({{5, 1}, {9, 2}, {5, 3}});
  hidden_by_what_is_taken[1].available = false;
  const std::string why_zero = rank(zero, {}).degenerate, why_alike = rank(alike, {}).degenerate;
  EXPECT_NE(why_zero, "");
  EXPECT_NE(why_alike, "");
  EXPECT_NE(why_zero, why_alike);
  EXPECT_EQ(why_zero.find('\n'), std::string::npos);
  EXPECT_NE(rank(nearly_alike, {}).degenerate, "");
  EXPECT_EQ(rank(apart, {}).degenerate, "");
  EXPECT_NE(rank(hidden_by_what_is_taken, {}).degenerate, "");
}

// Several at the top, all at the same value: the gain does not choose among them.
TEST(Rank, SaysThatAGainIsSaturated) {
  auto saturated = candidates({{7, 1}, {7, 2}, {7, 3}, {7, 4}, {1, 1}});
  EXPECT_NE(rank(saturated, {}).degenerate, "");
}

TEST(Rank, OfHalfAtTheTopTheGainStillChooses) {
  auto half = candidates({{7, 1}, {7, 2}, {1, 1}, {2, 1}}), most = candidates({{7, 1}, {7, 2}, {1, 1}});
  EXPECT_EQ(rank(half, {}).degenerate, "");
  EXPECT_EQ(rank(most, {}).degenerate, "2 of 3 candidates tie at the largest gain, 7");
}

TEST(Rank, TheOnlyCandidateLeftIsNotDegenerate) {
  auto one = candidates({{5, 1}});
  const Ranking ranking = rank(one, {});
  EXPECT_EQ(ranking.best, 0u);
  EXPECT_EQ(ranking.degenerate, "");
}

TEST(Rank, GainsThatAreNoNumberDoNotWin) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto c = candidates({{nan, 1}, {2, 1}, {3, 1}});
  const Ranking ranking = rank(c, {});
  EXPECT_TRUE(ranking.best != 0u || !ranking.degenerate.empty());
}

}  // namespace
}  // namespace nextview
