#include "core/setting/numbers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nextview {
namespace {

TEST(Numbers, AreSeparatedBySpacesOrCommas) {
  const std::vector<double> expected = {1, -2.5, 3e-2};
  for (const char* text : {"1 -2.5 3e-2", "1,-2.5,3e-2", " 1, -2.5 ,3e-2 "})
    EXPECT_EQ(numbers("a.key", text, 3, "three numbers"), expected) << text;
}

TEST(Numbers, WhatTheyAreNotIsSaidInOneLine) {
  for (const char* text : {"", "1 2", "1 2 3 4", "1 2 x", "1 2 3x", "1 2 nan", "1 2 inf", "1 2 1e999"}) try {
      numbers("a.key", text, 3, "three numbers");
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "a.key takes three numbers, not '" + std::string(text) + "'");
    }
}

}  // namespace
}  // namespace nextview
