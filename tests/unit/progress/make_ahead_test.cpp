#include "core/progress/make_ahead.hpp"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace nextview {
namespace {

TEST(MakeAhead, EachIsBegunAndTakenInOrderAfterItWasMade) {
  std::vector<int> made(20), taken;
  std::vector<std::size_t> begun;
  make_ahead(
      made.size(), [&](std::size_t i) { begun.push_back(i); }, [&](std::size_t i) { made[i] = int(i * i); },
      [&](std::size_t i) {
        EXPECT_EQ(begun.size(), i + 1);
        for (std::size_t far = i + 8; far < made.size(); ++far) EXPECT_EQ(made[far], 0) << "too far ahead of " << i;
        taken.push_back(made[i]);
      });
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_EQ(taken.at(i), int(i * i));
}

TEST(MakeAhead, TheFirstFailureIsToldOfWhenItIsItsTurn) {
  std::vector<std::size_t> taken;
  try {
    make_ahead(
        9, [](std::size_t) {},
        [](std::size_t i) {
          if (i >= 3) throw std::runtime_error(std::to_string(i));
        },
        [&](std::size_t i) { taken.push_back(i); });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "3");
  }
  EXPECT_THAT(taken, testing::ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace nextview
