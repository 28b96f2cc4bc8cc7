#include "core/progress/part.hpp"

#include <gtest/gtest.h>

#include <string>

namespace nextview {
namespace {

TEST(PartOfProgress, GoesFromItsBeginToItsEnd) {
  double heard = -1.0;
  std::string of;
  const Progress whole = [&](double fraction, std::string_view what) { heard = fraction, of = what; };
  const Progress later = part(whole, 0.25, 0.75);
  for (const auto& [fraction, expected] : {std::pair(0.0, 0.25), {0.5, 0.5}, {0.75, 0.625}, {1.0, 0.75}}) {
    later(fraction, "this");
    EXPECT_DOUBLE_EQ(heard, expected);
  }
  EXPECT_EQ(of, "this");
}

TEST(PartOfProgress, OfNothingIsNothing) { EXPECT_FALSE(part({}, 0.0, 1.0)); }

}  // namespace
}  // namespace nextview
