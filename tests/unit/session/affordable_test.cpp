// What a scan needs is told before it begins.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "core/memory/available_memory.hpp"
#include "core/session/session_parts.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

constexpr double pixels = 16384.0 * 16384.0;  // of the largest image

/// Scans of so many views of the largest images: more than any machine has room for.
Configuration huge(int views) {
  Configuration c = small_scan();
  c.sensor.width = c.sensor.height = 16384;
  c.views.layout = ViewLayout::file;  // as many as are asked for
  c.termination.views = views;
  return c;
}

std::string refusal(const Configuration& c) {
  try {
    affordable(c);
    return "";
  } catch (const OutOfMemory& error) {
    return error.what();
  }
}

/// What it says that a scan needs [bytes a pixel].
double needed(int views) {
  const std::string said = refusal(huge(views));
  std::smatch found;
  EXPECT_TRUE(std::regex_search(said, found, std::regex(" needs ([0-9.]+) GB"))) << said;
  return found.empty() ? 0.0 : 1e9 * std::stod(found[1]) / pixels;
}

TEST(Affordable, ASmallScanIs) {
  EXPECT_EQ(refusal(small_scan()), "");
  Configuration one = small_scan();
  one.termination.views = 1;
  one.sensor.width = 2000, one.sensor.height = 1500;
  EXPECT_EQ(refusal(one), "") << "of few large images, too: less than a gigabyte";
}

TEST(Affordable, AHugeOneSaysWhatItIsAndWhatToDo) {
  EXPECT_THAT(refusal(huge(3000)),
              testing::AllOf(HasSubstr("a scan of 3000 images of 16384 x 16384 pixels needs "),
                             HasSubstr("use fewer pixels (sensor.width, sensor.height) or views (termination.views)")));
  Configuration few_candidates = huge(3000);
  few_candidates.views.layout = ViewLayout::sphere;
  few_candidates.views.count = 1999;
  EXPECT_THAT(refusal(few_candidates), HasSubstr("a scan of 2000 images")) << "the start view, and each candidate";
}

// Of each view a point of three floats a pixel stays. While one is taken there are, a pixel, at least its ray, its
// range and its point, of seven floats together.
TEST(Affordable, EachViewStaysAndOneIsTaken) {
  const double a_view = (needed(9000) - needed(3000)) / 6000.0;
  EXPECT_NEAR(a_view, 3.0 * sizeof(float), 0.01);
  constexpr double rounding = 0.5;  // of what is said to 0.1 GB
  EXPECT_GE(needed(3000) - 3000.0 * a_view, 7.0 * sizeof(float) - rounding);
}

}  // namespace
}  // namespace nextview
