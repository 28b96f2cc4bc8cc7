#include <gtest/gtest.h>

#include <cmath>

#include "core/planner/new_surface_policy.hpp"

namespace nextview {
namespace {

std::vector<TakenView> views(std::vector<std::pair<double, double>> expected_and_found) {
  std::vector<TakenView> taken;
  for (const auto& [expected, found] : expected_and_found) taken.push_back({{}, Pose::Identity(), expected, found});
  return taken;
}

TEST(PromiseKept, IsOneBeforeAnythingWasExpected) {
  EXPECT_EQ(promise_kept({}), 1.0);
  EXPECT_EQ(promise_kept(views({{0, 500}, {0, 20}})), 1.0) << "the start view, and custom ones, promise nothing";
}

TEST(PromiseKept, IsFoundOverExpectedTheLastMost) {
  // As if a view before had kept its promise: (0.4 x 100 + 50) / (0.4 x 100 + 100).
  EXPECT_NEAR(promise_kept(views({{0, 500}, {100, 50}})), 90.0 / 140.0, 1e-12);
  // The second promise had that factor already: as modelled it is 280.
  const double kept = 90.0 / 140.0;
  EXPECT_NEAR(promise_kept(views({{0, 500}, {100, 50}, {180, 300}})), (0.4 * 90 + 300) / (0.4 * 140 + 180 / kept),
              1e-12);
  EXPECT_NEAR(promise_kept(views({{100, 100}, {50, 50}, {20, 20}})), 1.0, 1e-12);
}

TEST(PromiseKept, IsBounded) {
  std::vector<std::pair<double, double>> nothing, plenty;
  for (int i = 0; i < 20; ++i) nothing.emplace_back(100, 0), plenty.emplace_back(1, 1e6);
  EXPECT_EQ(promise_kept(views(nothing)), 0.02) << "never 0, which would not tell candidates apart";
  EXPECT_EQ(promise_kept(views(plenty)), 5.0);
}

TEST(PromiseKept, ConvergesToWhatIsAlwaysKept) {
  double kept = 1.0;
  std::vector<std::pair<double, double>> all;
  for (int i = 0; i < 30; ++i) {
    all.emplace_back(100.0 * kept, 60.0);  // the model says 100, 60 are found
    kept = promise_kept(views(all));
  }
  EXPECT_NEAR(kept, 0.6, 1e-6);
}

TEST(ShownOverExpected, RisesFromWhatIsLeftAtLastAndFallsToTheFirstView) {
  EXPECT_EQ(shown_over_expected(0.0), shown_over_expected(0.01)) << "no smaller where nearly nothing is left";
  EXPECT_EQ(shown_over_expected(1.0), shown_over_expected(0.7));
  EXPECT_EQ(shown_over_expected(0.04), 1.25);
  EXPECT_NEAR(shown_over_expected(0.1), 1.25, 1e-12);
  EXPECT_NEAR(shown_over_expected(0.02), (0.6 + 1.25) / 2, 1e-12) << "half of the way, by its logarithm";
  EXPECT_NEAR(shown_over_expected(std::sqrt(0.3 * 0.7)), (1.25 + 0.9) / 2, 1e-12);
}

}  // namespace
}  // namespace nextview
