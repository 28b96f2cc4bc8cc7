#include "core/progress/seconds_left.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(SecondsLeft, AreToldOnceTheyAreMoreThanAGuess) {
  EXPECT_EQ(seconds_left(0.25, 3.0), 9.0);
  EXPECT_EQ(seconds_left(0.9, 10.0), 2.0) << "whole seconds";
  EXPECT_EQ(seconds_left(0.01, 30.0), std::nullopt);
  EXPECT_EQ(seconds_left(0.5, 0.8), std::nullopt);
}

}  // namespace
}  // namespace nextview
