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
    EXPECT_EQ(BitMask(expected), mask);
    BitMask by_words(size), one_by_one(size);
    by_words.set_words(mask.words());
    EXPECT_EQ(by_words, mask);
    mask.for_each([&](std::size_t i) { one_by_one.set(i); });
    EXPECT_EQ(one_by_one, mask);
  }
}

TEST(BitMask, TakesWordsFromAnywhereAndRefusesThoseOfAnother) {
  for (const std::size_t first : {0, 1, 63, 64, 70}) {
    BitMask mask(140);
    mask.add_word(first, 0b1011);
    std::vector<std::size_t> set;
    mask.for_each([&](std::size_t i) { set.push_back(i - first); });
    EXPECT_EQ(set, (std::vector<std::size_t>{0, 1, 3})) << first;
    EXPECT_EQ(mask.word(first), 0b1011u);
    EXPECT_EQ(mask.word(first + 1), 0b101u);
    mask.set(first, false);
    EXPECT_FALSE(mask[first]);
  }
  BitMask mask(65);
  EXPECT_THROW(mask.set_words({1}), std::invalid_argument);
  EXPECT_THROW(mask.set_words({1, 2}), std::invalid_argument) << "the 67th of 65";
}

}  // namespace
}  // namespace nextview
