#include <gtest/gtest.h>

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

}  // namespace
}  // namespace nextview
