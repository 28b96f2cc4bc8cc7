#include "core/file/csv_cell.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(CsvCell, IsInQuotesWhereItWouldEndOtherwise) {
  EXPECT_EQ(csv_cell(""), "");
  EXPECT_EQ(csv_cell("slotted plate; 4 views"), "slotted plate; 4 views");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("the \"big\" one"), "\"the \"\"big\"\" one\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_cell("two\rlines"), "\"two\rlines\"");
}

}  // namespace
}  // namespace nextview
