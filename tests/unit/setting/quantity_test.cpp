#include "core/setting/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/setting/setting.hpp"

namespace nextview {
namespace {

double read(const std::string& text, const std::string& unit = "m") {
  double value = -77;
  EXPECT_TRUE(read_quantity(text, unit, value)) << text;
  return value;
}

std::string complaint(Setting& setting, const std::string& text) try {
  setting.set(text);
  return "no complaint";
} catch (const std::invalid_argument& error) {
  return error.what();
}

TEST(Quantity, ALengthHasAnyOfItsUnits) {
  EXPECT_EQ(read("0.005"), 0.005);
  EXPECT_EQ(read("0.005 m"), 0.005);
  EXPECT_EQ(read("5 mm"), 0.005);
  EXPECT_EQ(read(" 5mm "), 0.005);
  EXPECT_EQ(read("1.2 cm"), 0.012);
  EXPECT_EQ(read("300 um"), 0.0003);
  EXPECT_EQ(read("300 µm"), 0.0003);
  EXPECT_NEAR(read("2 in"), 0.0508, 1e-17);
  EXPECT_NEAR(read("5e-1 mm"), 0.0005, 1e-18);
  EXPECT_EQ(read("5e-1 m"), 0.5);
  EXPECT_NEAR(read("2E1 cm"), 0.2, 1e-16);
  EXPECT_NEAR(read("1e2 um"), 0.0001, 1e-19);
  EXPECT_NEAR(read("1e1 in"), 0.254, 1e-16);
}

TEST(Quantity, OtherUnitsAreNamedAsTheyAreAndNotMixed) {
  EXPECT_EQ(read("12 deg", "deg"), 12);
  EXPECT_EQ(read("12", "deg"), 12);
  for (const char* wrong : {"12 mm", "12 rad", "deg", ""}) {
    double value = -77;
    EXPECT_FALSE(read_quantity(wrong, "deg", value)) << wrong;
    EXPECT_EQ(value, -77);
  }
  for (const char* wrong : {"mm", "5 furlongs", "5 mm x", "five", "5,0", "0x10", "--5", "1e999 mm"}) {
    double value = -77;
    EXPECT_FALSE(read_quantity(wrong, "m", value)) << wrong;
    EXPECT_EQ(value, -77);
  }
}

/// Against the decimal point moved by hand.
TEST(Quantity, MillimetresAreExact) {
  for (int i = 1; i < 20000; i += 7) {
    const std::string metres = "0." +
                               std::string(i < 10     ? "000"
                                           : i < 100  ? "00"
                                           : i < 1000 ? "0"
                                                      : "") +
                               std::to_string(i);
    if (i >= 10000) continue;
    const std::string tenths = std::to_string(i / 10) + "." + std::to_string(i % 10) + " mm";
    EXPECT_EQ(read(tenths), std::stod(metres)) << tenths;
  }
}

TEST(Quantity, WhatIsShownReadsBack) {
  for (const double length : {0.0, 0.005, 0.0123456, 0.999999, 1.0, 1.5, 12.25, 1e-6, -0.02, -3.0})
    EXPECT_EQ(read(quantity_text(length)), length) << quantity_text(length);
  EXPECT_EQ(quantity_text(0.005), "5 mm");
  EXPECT_EQ(quantity_text(0.999), "999 mm");
  EXPECT_EQ(quantity_text(-1.1), "-1.1 m");
  EXPECT_EQ(quantity_text(1.5), "1.5 m");
  EXPECT_EQ(quantity_text(0.0), "0 m");
}

TEST(Quantity, ASettingTakesIt) {
  double edge = 0;
  Setting setting{"map.resolution", "m", "edge of a voxel", &edge};
  setting.set("5 mm");
  EXPECT_EQ(edge, 0.005);
  EXPECT_EQ(setting.text(), "0.005");
  EXPECT_EQ(complaint(setting, "2 parsec"),
            "map.resolution takes a number [m], or one with a unit (m, cm, mm, um, µm, in), not '2 parsec'");
  setting.unit = "deg";
  EXPECT_EQ(complaint(setting, "5 mm"), "map.resolution takes a number [deg], not '5 mm'");
  setting.unit = "";
  EXPECT_EQ(complaint(setting, "five"), "map.resolution takes a number, not 'five'");
}

}  // namespace
}  // namespace nextview
