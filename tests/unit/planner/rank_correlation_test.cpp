#include "core/planner/rank_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nextview {
namespace {

using List = std::vector<double>;

TEST(RankCorrelation, IsOneForTheSameOrderWhateverTheValues) {
  EXPECT_DOUBLE_EQ(rank_correlation(List{1, 2, 3, 4}, List{-5, 0, 0.1, 1e9}), 1.0);
}

TEST(RankCorrelation, IsMinusOneForTheOppositeOrder) {
  EXPECT_DOUBLE_EQ(rank_correlation(List{1, 2, 3}, List{3, 2, 1}), -1.0);
}

TEST(RankCorrelation, AgreesWithTheFormulaWithoutTies) {
  // 1 - 6 sum d^2 / (n (n^2 - 1)), d = 0, 2, -1, -1, 0
  EXPECT_NEAR(rank_correlation(List{10, 20, 30, 40, 50}, List{1, 4, 2, 3, 5}), 1.0 - 6.0 * 6.0 / (5.0 * 24.0), 1e-12);
}

TEST(RankCorrelation, TiesTakeTheirMeanRank) {
  // Ranks 0, 1.5, 1.5, 3 and 0, 1, 2, 3: covariance 4.5, variances 4.5 and 5.
  EXPECT_NEAR(rank_correlation(List{1, 2, 2, 3}, List{1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5.0), 1e-12);
}

TEST(RankCorrelation, IsNothingForConstantsAndForNothing) {
  EXPECT_EQ(rank_correlation(List{1, 1, 1}, List{1, 2, 3}), 0.0);
  EXPECT_EQ(rank_correlation(List{}, List{}), 0.0);
}

}  // namespace
}  // namespace nextview
