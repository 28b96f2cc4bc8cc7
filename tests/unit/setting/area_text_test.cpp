#include "core/setting/area_text.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(AreaText, HasTheUnitThatSuitsIt) {
  EXPECT_EQ(area_text(0.0), "0 cm²");
  EXPECT_EQ(area_text(0.0612), "6.12 mm²");
  EXPECT_EQ(area_text(0.771), "0.771 cm²");
  EXPECT_EQ(area_text(1.0), "1 cm²");
  EXPECT_EQ(area_text(45.27), "45.3 cm²");
  EXPECT_EQ(area_text(99.97), "100 cm²");
  EXPECT_EQ(area_text(1234.5), "1234 cm²");
  EXPECT_EQ(area_text(28'300.0), "2.83 m²");
  EXPECT_EQ(area_text(2.83e7), "2830 m²");
}

TEST(AreaText, HasTheUnitOfTheLargestThatItStandsBeside) {
  EXPECT_EQ(area_text(8442.0, 11'200.0), "0.844 m²");
  EXPECT_EQ(area_text(0.0612, 3.0), "0.0612 cm²");
  EXPECT_EQ(area_text(0.0612, 0.08), "6.12 mm²");
}

}  // namespace
}  // namespace nextview
