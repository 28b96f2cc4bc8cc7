#include "core/map/bit_rows.hpp"

#include <gtest/gtest.h>

#include "tests/unit/map/made_rows.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using made_rows::cells;
using made_rows::for_each_cell;
using made_rows::random_rows;

const Vector3i row_sizes[] = {{1, 1, 1}, {7, 3, 2}, {64, 2, 3}, {65, 3, 2}, {130, 4, 3}};

bool is_beside(const Vector3i& a, const Vector3i& b) { return (a - b).cwiseAbs().maxCoeff() <= 1; }

TEST(BitRows, NeighboursAndGrowthAreWhatComparingAllFinds) {
  std::mt19937 random(1);
  for (const Vector3i& size : row_sizes)
    for (const double share : {0.02, 0.4, 1.0}) {
      const BitRows rows = random_rows(random, size, share);
      BitRows grown = rows;
      grown.grow({});
      const std::vector<Vector3i> set = cells(rows);
      for_each_cell(size, [&](const Vector3i& cell) {
        int around = 0;
        Vector3i ways = Vector3i::Zero();
        for (const Vector3i& other : set)
          if (is_beside(cell, other) && cell != other) ++around, ways += other - cell;
        ASSERT_EQ(rows.neighbours(cell), around) << cell.transpose() << " of " << size.transpose();
        ASSERT_EQ(rows.ways_to_neighbours(cell), ways) << cell.transpose() << " of " << size.transpose();
        ASSERT_EQ(grown.at(cell), around > 0 || rows.at(cell)) << cell.transpose() << " of " << size.transpose();
      });
    }
}

TEST(BitRows, HalvedIsAnyOfEight) {
  std::mt19937 random(7);
  for (const Vector3i& size : row_sizes)
    for (const double share : {0.05, 0.6}) {
      const BitRows rows = random_rows(random, size, share), half = rows.halved();
      ASSERT_EQ(half.size(), Vector3i((size.array() + 1) / 2));
      BitRows expected(half.size());
      for (const Vector3i& cell : cells(rows)) expected.set(cell / 2);
      ASSERT_EQ(cells(half), cells(expected)) << size.transpose();
    }
}

TEST(BitRows, RanksCountThoseBefore) {
  std::mt19937 random(2);
  for (const Vector3i& size : row_sizes) {
    const BitRows rows = random_rows(random, size, 0.3);
    const std::vector<std::uint32_t> counts = rows.counts_before();
    std::size_t before = 0;
    for_each_cell(size, [&](const Vector3i& cell) {
      ASSERT_EQ(rows.rank(cell, counts), before) << cell.transpose();
      before += rows.at(cell);
    });
    EXPECT_EQ(counts.back(), before);
  }
}

TEST(BitRows, EightAreSetWhereTheyLieInTheRow) {
  std::mt19937 random(3);
  for (const Vector3i& size : row_sizes)
    for (int first = -8; first <= size.x(); ++first) {
      const auto bits = static_cast<std::uint8_t>(random());
      BitRows rows(size);
      rows.set_eight({first, size.y() - 1, 0}, bits);
      std::vector<Vector3i> expected;
      for (int i = 0; i < 8; ++i)
        if ((bits >> i & 1) && first + i >= 0 && first + i < size.x())
          expected.emplace_back(first + i, size.y() - 1, 0);
      ASSERT_EQ(cells(rows), expected) << first << " of " << size.transpose();
      EXPECT_EQ(rows.counts_before().back(), expected.size()) << "nothing is set beyond the row's end";
    }
}

TEST(BitRows, EitherAndComplement) {
  std::mt19937 random(4);
  for (const Vector3i& size : row_sizes) {
    const BitRows a = random_rows(random, size, 0.2), b = random_rows(random, size, 0.3);
    const BitRows either = BitRows::either(a, b), neither = either.complement();
    for_each_cell(size, [&](const Vector3i& cell) {
      ASSERT_EQ(either.at(cell), a.at(cell) || b.at(cell));
      ASSERT_EQ(neither.at(cell), !either.at(cell));
    });
    EXPECT_EQ(neither.counts_before().back() + either.counts_before().back(), std::size_t(size.prod()));
  }
}

TEST(BitRows, ARowIsVisitedInItsOrder) {
  std::mt19937 random(5);
  const BitRows rows = random_rows(random, {130, 2, 2}, 0.1);
  std::vector<Vector3i> visited;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y) rows.for_each_in_row(y, z, [&](int x) { visited.emplace_back(x, y, z); });
  EXPECT_EQ(visited, cells(rows));
}

}  // namespace
}  // namespace nextview
