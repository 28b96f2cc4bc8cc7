// Steps that are known, whether or not there is something to come back to at each.
#include "ui/workbench/step_tree.hpp"

#include <gmock/gmock.h>

#include "core/session/session.hpp"
#include "tests/unit/workbench/small_scan.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::Pair;

/// A session at its beginning; each step of it can be put into a tree, as after another one.
class StepTreeTest : public testing::Test {
 protected:
  StepTreeTest() : tree_(stand(), session_.camera()) {}

  Stand stand() const {
    return {session_.configuration().termination, {}, {}, std::make_shared<ScanState>(session_.state()), seen_};
  }
  /// Takes a step from `from` on, which gets this number.
  void step(std::uint32_t number, std::uint32_t from) {
    session_.step();
    tree_.at = from;
    tree_.step(number, stand());
  }
  const ScanState* state(std::uint32_t number) const { return tree_.stand(number)->state.get(); }

  Session session_{small_scan()};
  std::shared_ptr<SeenSurface> seen_ = std::make_shared<SeenSurface>(session_);
  StepTree tree_;
};

TEST_F(StepTreeTest, EachStateIsKeptWithTheOneBeforeItAndTheFirstWithNone) {
  EXPECT_THAT(tree_.states(), ElementsAre(Pair(state(0), nullptr)));
  step(1, 0);
  step(2, 1);
  step(3, 1);
  EXPECT_THAT(tree_.states(), ElementsAre(Pair(state(0), nullptr), Pair(state(1), state(0)), Pair(state(2), state(1)),
                                          Pair(state(3), state(1))));
}

TEST_F(StepTreeTest, LinesLeadFromTheFirstStepToAnyOther) {
  step(1, 0);
  step(2, 1);
  step(3, 1);
  EXPECT_THAT(tree_.line(0), ElementsAre());
  EXPECT_THAT(tree_.line(2), ElementsAre(1, 2));
  EXPECT_THAT(tree_.line(3), ElementsAre(1, 3));
  EXPECT_EQ(tree_.at, 3u);
  EXPECT_EQ(tree_.last_number(), 3u);
  EXPECT_TRUE(tree_.has(2));
  EXPECT_FALSE(tree_.has(4));
  EXPECT_EQ(tree_.nearest_here(3), 3u);
  EXPECT_TRUE(tree_.not_here(3).empty());
  EXPECT_THROW(tree_.step(3, stand()), std::logic_error);
}

TEST_F(StepTreeTest, TheTimelineHasEachStepWithItsNumbersAndItsPicture) {
  step(1, 0);
  step(2, 1);
  const Timeline timeline = tree_.timeline();
  ASSERT_EQ(timeline.steps.size(), 2u) << "the beginning is none";
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(timeline.steps[k].number, k + 1);
    EXPECT_EQ(timeline.steps[k].after, k);
    ASSERT_TRUE(timeline.steps[k].record && timeline.steps[k].picture);
    EXPECT_EQ(timeline.steps[k].record->step, session_.records()[k].step);
    EXPECT_EQ(timeline.steps[k].record->entropy, session_.records()[k].entropy);
  }
  EXPECT_EQ(timeline.at, 2u);
}

}  // namespace
}  // namespace nextview
