#include "core/planner/remaining_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

NewSurfaceForecast forecast(std::vector<std::vector<float>> parts) {
  NewSurfaceForecast result;
  for (std::size_t p = 0; p < parts.front().size(); ++p) {
    float& most = result.most.emplace_back(0.0f);
    for (const auto& of_view : parts) most = std::max(most, of_view[p]);
    result.all += most;
  }
  result.parts = std::move(parts);
  return result;
}

TEST(CoveringViews, TakesTheViewThatAddsMostUntilEnoughIsShown) {
  // All: 5 + 4 + 3 + 1 = 13. View 1 counts for 5 + 2.5; view 3 adds 3, where view 2 adds 1.5 + 1.25, and then 1.5.
  const auto f = forecast({{3, 0, 0, 1}, {5, 2, 0, 0}, {0, 4, 1, 0}, {0, 0, 3, 0}});
  EXPECT_THAT(covering_views(f, 0.0).views, ElementsAre(1, 3, 2, 0));
  EXPECT_THAT(covering_views(f, 1.1).views, ElementsAre(1, 3, 2));
  EXPECT_THAT(covering_views(f, 3.0).views, ElementsAre(1, 3));
  EXPECT_TRUE(covering_views(f, 3.0).is_least);
  EXPECT_THAT(covering_views(f, 13.0).views, IsEmpty());
}

TEST(CoveringViews, FourFifthsOfAPartAreThePart) {
  EXPECT_THAT(covering_views(forecast({{4.01f, 0}, {5, 0}, {0, 2}}), 0.0).views, ElementsAre(0, 2));
  EXPECT_THAT(covering_views(forecast({{3.99f, 0}, {5, 0}, {0, 2}}), 0.0).views, ElementsAre(1, 2));
  EXPECT_THAT(covering_views(forecast({{2, 0}, {2, 0}, {5, 0}, {0, 2}}), 0.0).views, ElementsAre(2, 3));
}

TEST(CoveringViews, EndsWhereNothingIsLeft) {
  EXPECT_THAT(covering_views(forecast({{1, 1}, {1, 1}}), 0.0).views, ElementsAre(0));
  EXPECT_THAT(covering_views(forecast({{0, 0}}), 0.0).views, IsEmpty());
  EXPECT_THAT(covering_views(NewSurfaceForecast{}, 0.0).views, IsEmpty());
}

double length(const Vector3& from, const std::vector<Vector3>& way) {
  double length = (way.front() - from).norm();
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

TEST(ShortWay, IsHardlyLongerThanTheShortestOfAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double sum = 0.0, shortest_sum = 0.0;
  for (int round = 0; round < 50; ++round) {
    std::vector<Vector3> stops;
    for (int i = 0; i < 6; ++i) stops.emplace_back(uniform(random), uniform(random), uniform(random));
    const Vector3 from(uniform(random), uniform(random), uniform(random));
    std::vector<int> order = {0, 1, 2, 3, 4, 5};
    double shortest = 1e9;
    do {
      std::vector<Vector3> way;
      for (const int i : order) way.push_back(stops[std::size_t(i)]);
      shortest = std::min(shortest, length(from, way));
    } while (std::ranges::next_permutation(order).found);
    const double found = short_way(from, stops);
    EXPECT_GE(found, shortest - 1e-9);
    EXPECT_LE(found, 1.35 * shortest);
    sum += found, shortest_sum += shortest;
  }
  EXPECT_LT(sum, 1.05 * shortest_sum);
}

TEST(ShortWay, OfNoStopsIsNone) {
  EXPECT_EQ(short_way({1, 2, 3}, {}), 0.0);
  EXPECT_EQ(short_way({0, 0, 0}, {{0, 3, 4}}), 5.0);
}

}  // namespace
}  // namespace nextview
