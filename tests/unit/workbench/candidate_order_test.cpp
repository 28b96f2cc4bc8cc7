#include "ui/workbench/candidate_order.hpp"

#include <gmock/gmock.h>

namespace nextview {
namespace {

using testing::ElementsAre;

const std::vector<Candidate> candidates = {
    {true, 5, 1, 0.1},
    {true, 9, 3, -0.2},
    {false, 100, 0, 7},
    {true, 5, 2, 0.3},
};

TEST(CandidateOrder, ByEachColumn) {
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::view, true), ElementsAre(0, 1, 3, 2));
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::view, false), ElementsAre(3, 1, 0, 2));
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::cost, true), ElementsAre(0, 3, 1, 2));
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::utility, false), ElementsAre(3, 0, 1, 2));
}

TEST(CandidateOrder, EqualsStayInListOrder) {
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::gain, false), ElementsAre(1, 0, 3, 2));
  EXPECT_THAT(sorted_candidates(candidates, CandidateColumn::gain, true), ElementsAre(0, 3, 1, 2));
}

TEST(CandidateOrder, NoneIsFine) { EXPECT_TRUE(sorted_candidates({}, CandidateColumn::gain, true).empty()); }

}  // namespace
}  // namespace nextview
