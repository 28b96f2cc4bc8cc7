#include "ui/window/shortcuts.hpp"

#include <gtest/gtest.h>

#include <set>

namespace nextview {
namespace {

TEST(Shortcuts, NoKeyMeansTwoThings) {
  std::set<std::pair<Key, bool>> keys;
  for (const Shortcut& s : shortcuts()) EXPECT_TRUE(keys.emplace(s.key, s.control).second) << s.keys;
}

TEST(Shortcuts, EveryActionHasAKey) {
  for (int action = 0; action <= int(Action::quit); ++action) EXPECT_FALSE(keys_of(Action(action)).empty()) << action;
  EXPECT_EQ(keys_of(Action::step), "S");
  EXPECT_EQ(keys_of(Action::quit), "Ctrl+Q");
}

}  // namespace
}  // namespace nextview
