#include "ui/window/window_preferences.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(WindowPreferences, TextIsLargerWherePixelsAreSmall) {
  EXPECT_EQ(usual_text_scale(1920, 1080, 530), 1.0);
  EXPECT_EQ(usual_text_scale(3840, 2160, 600), 1.75) << "163 pixels an inch";
  EXPECT_EQ(usual_text_scale(3840, 2160, 1200), 1.0) << "as large as a table";
}

TEST(WindowPreferences, TextFollowsTheHeightWhereTheDisplayDoesNotKnowItsSize) {
  for (const auto& [width, height, scale] :
       {std::tuple(640, 480, 1.0), {1280, 800, 1.0}, {2560, 1440, 1.0}, {3840, 2160, 1.5}, {7680, 4320, 3.0}}) {
    EXPECT_EQ(usual_text_scale(width, height, 0), scale) << height;
    EXPECT_EQ(usual_text_scale(width, height, int(std::lround(width * 25.4 / 96))), scale) << height;
  }
}

}  // namespace
}  // namespace nextview
