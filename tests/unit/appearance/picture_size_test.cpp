#include "ui/appearance/picture_size.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace nextview {
namespace {

std::string error_of(const std::string& text) {
  try {
    picture_size(text, "--size");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(PictureSize, IsWidthTimesHeight) {
  EXPECT_EQ(picture_size("1920x1080", "--size"), (PictureSize{1920, 1080}));
  EXPECT_EQ(picture_size("16x8192", "--size"), (PictureSize{16, 8192}));
  EXPECT_EQ(picture_size("8192x16", "--size"), (PictureSize{8192, 16}));
}

TEST(PictureSize, OthersAreRefusedInALineThatNamesTheOption) {
  for (const char* bad : {"", "x", "640", "640x", "x480", "640 x 480", "640X480", "640x480x3", "640x480 ", "-640x480",
                          "640x-480", "15x480", "640x15", "8193x480", "640x8193", "99999999999x480", "640.5x480"})
    EXPECT_EQ(error_of(bad),
              std::string("--size: takes WIDTHxHEIGHT in pixels, each from 16 to 8192, not '") + bad + "'");
}

TEST(PictureScale, GrowsWithTheSideThatGrowsLeastAndNeverBelowOne) {
  EXPECT_EQ(picture_scale({1280, 800}), 1.0);
  EXPECT_EQ(picture_scale({2560, 1600}), 2.0);
  EXPECT_EQ(picture_scale({2560, 1200}), 1.5);
  EXPECT_EQ(picture_scale({1920, 1600}), 1.5);
  EXPECT_EQ(picture_scale({2560, 400}), 1.0);
  EXPECT_EQ(picture_scale({64, 64}), 1.0);
}

}  // namespace
}  // namespace nextview
