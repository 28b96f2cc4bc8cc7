// Undo takes back what was done last, a selection or a change of the session.
#include "ui/workbench/selection_history.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

Selection looking_at(std::size_t candidate) {
  Selection selection;
  selection.view = {ViewSelection::Kind::candidate, candidate};
  return selection;
}

TEST(SelectionHistory, GoesBackAndForward) {
  SelectionHistory history;
  history.push({}, {1, 2});
  history.push(looking_at(3), {1, 2});
  Selection now = looking_at(5);
  now = history.undo(now);
  EXPECT_EQ(now, looking_at(3));
  now = history.undo(now);
  EXPECT_EQ(now, Selection());
  EXPECT_FALSE(history.can_undo({1, 2}));
  now = history.redo(now);
  now = history.redo(now);
  EXPECT_EQ(now, looking_at(5));
  EXPECT_FALSE(history.can_redo({1, 2}));
}

TEST(SelectionHistory, WaitsForLaterChangesOfTheSession) {
  SelectionHistory history;
  history.push({}, {1, 2});
  EXPECT_FALSE(history.can_undo({1, 3})) << "a view was taken since: that goes first";
  EXPECT_TRUE(history.can_undo({1, 2}));
  EXPECT_FALSE(history.can_undo({2, 2})) << "of another session its numbers mean nothing";
}

TEST(SelectionHistory, ANewOneForgetsWhatWasUndone) {
  SelectionHistory history;
  history.push({}, {1, 2});
  history.undo(looking_at(1));
  history.push({}, {1, 2});
  EXPECT_FALSE(history.can_redo({1, 2}));
  history.push(looking_at(1), {1, 1});  // after an undo of the session
  EXPECT_TRUE(history.can_undo({1, 1}));
  history.undo({});
  EXPECT_FALSE(history.can_undo({1, 2})) << "that change is no more";
}

}  // namespace
}  // namespace nextview
