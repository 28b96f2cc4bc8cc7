#include "core/map/bit_mask.hpp"

#include <gtest/gtest.h>

#include <random>

namespace nextview {
namespace {

TEST(BitMask, HoldsWhatWasAdded) {
  std::mt19937 random(1);
  for (const std::size_t size : {0, 1, 63, 64, 65, 1000}) {
    BitMask mask(size);
    std::vector<std::uint8_t> expected(size);
    for (int time = 0; time < 3; ++time) {
      std::vector<std::uint8_t> bytes(size);
      for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = random() % 4 == 0 ? std::uint8_t(1 + random() % 255) : 0;
        expected[i] |= bytes[i] != 0;
      }
      mask.add(bytes);
    }
    EXPECT_EQ(mask.bytes(), expected);
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(mask[i], expected[i] != 0);
    EXPECT_LE(mask.memory(), size / 8 + 8);
    for (std::size_t length = 1; length <= size; ++length) {  // in rows that lie apart
      if (size % length != 0) continue;
      std::vector<std::uint8_t> apart(2 * size);
      for (std::size_t i = 0; i < size; ++i) apart[i / length * 2 * length + i % length] = expected[i];
      BitMask by_rows(size);
      by_rows.add_rows(length, [&](std::size_t row) { return &apart[row * 2 * length]; });
      EXPECT_EQ(by_rows, mask) << length;
    }
    BitMask same(size);
    EXPECT_EQ(same == mask, mask.bytes() == std::vector<std::uint8_t>(size));
    same.add(expected);
    EXPECT_EQ(same, mask);
  }
}

}  // namespace
}  // namespace nextview
