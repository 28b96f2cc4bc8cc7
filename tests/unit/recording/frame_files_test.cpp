// The names of frames' files: which come first, and which mean the same frame.
#include "core/recording/frame_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nextview {
namespace {

TEST(FrameFiles, NumbersInNamesCountAsNumbers) {
  const std::vector<std::string> ordered = {"",     "01",  "1",   "002", "02",     "2",       "2a",        "3",
                                            "0010", "10",  "100", "a",   "a-1-9",  "a-01-10", "a-1-10",    "a-2",
                                            "a2",   "a10", "b",   "b0",  "b00001", "b1.png",  "b00002.png"};
  for (std::size_t i = 0; i < ordered.size(); ++i)
    for (std::size_t k = 0; k < ordered.size(); ++k)
      EXPECT_EQ(natural_order(ordered[i], ordered[k]), i < k) << ordered[i] << " and " << ordered[k];
}

TEST(FrameFiles, KeysOfOneNumberAreOfOneFrame) {
  for (const auto& [a, b] :
       {std::pair{"1", "1"}, {"1", "01"}, {"0001", "001"}, {"0", "000"}, {"007", "7"}, {"a", "a"}}) {
    EXPECT_TRUE(same_key(a, b)) << a << " and " << b;
    EXPECT_TRUE(same_key(b, a)) << b << " and " << a;
  }
  for (const auto& [a, b] : {std::pair{"1", "2"},
                             {"1", "10"},
                             {"01", "10"},
                             {"0", ""},
                             {"", "0"},
                             {"a1", "a01"},
                             {"1a", "01a"},
                             {"1", "1_2"},
                             {"100", "1"},
                             {"0", "1"}})
    EXPECT_FALSE(same_key(a, b)) << a << " and " << b;
  EXPECT_TRUE(same_key("", "")) << "of patterns without a wildcard";
}

TEST(FrameFiles, TheLastNumberOfANameIsWithoutItsNoughts) {
  for (const auto& [text, number] : {std::pair{"frame-000012.color", "12"},
                                     {"7", "7"},
                                     {"01", "1"},
                                     {"00", "0"},
                                     {"000", "0"},
                                     {"a0b", "0"},
                                     {"12-34", "34"},
                                     {"12-34x", "34"},
                                     {"x100", "100"},
                                     {"0x0100y", "100"}})
    EXPECT_EQ(last_number(text), number) << text;
  EXPECT_EQ(last_number("frame"), std::nullopt);
  EXPECT_EQ(last_number(""), std::nullopt);
}

}  // namespace
}  // namespace nextview
