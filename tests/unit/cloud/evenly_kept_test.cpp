#include "core/cloud/evenly_kept.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace nextview {
namespace {

TEST(EvenlyKept, AreNoMoreThanAskedForAndAsFarApart) {
  std::vector<int> all(10);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(evenly_kept(all, 4), (std::vector<int>{0, 2, 5, 7}));
  EXPECT_EQ(evenly_kept(all, 1), std::vector<int>{0});
  for (std::size_t most = 1; most <= all.size(); ++most) EXPECT_EQ(evenly_kept(all, most).size(), most);
}

TEST(EvenlyKept, AreAllWhereThereAreNotMore) {
  EXPECT_EQ(evenly_kept(std::vector{3, 1, 2}, 3), (std::vector{3, 1, 2}));
  EXPECT_TRUE(evenly_kept(std::vector<int>(), 5).empty());
}

}  // namespace
}  // namespace nextview
