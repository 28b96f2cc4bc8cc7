#include "core/setting/setting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/setting/quantity.hpp"

namespace nextview {
namespace {

TEST(Nearest, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(nearest("kitten", {"sitting", "mitten", "bitter"}), "mitten");
  EXPECT_EQ(nearest("coverge", {"average", "coverage", "converge"}), "coverage");
  EXPECT_EQ(nearest("", {"abc", "a", "ab"}), "a");
  EXPECT_EQ(nearest("same", {"other", "same"}), "same");
  EXPECT_EQ(nearest("in", {"m", "inch"}), "inch") << "it begins so";
}

TEST(Nearest, CountsExchangedLettersOnceAndWhatPartsWordsNotAtAll) {
  EXPECT_EQ(nearest("abdc", {"abxx", "abcd"}), "abcd");
  EXPECT_EQ(nearest("Hit-Decay", {"hit_delay", "hit_decay"}), "hit_decay");
  EXPECT_EQ(nearest("downsampling", {"down", "down_sampling"}), "down_sampling");
}

TEST(Nearest, IsNotSaidToBeMeantWhereItIsFar) {
  EXPECT_EQ(did_you_mean("furlong", {"auto", "m", "mm", "cm", "inch"}), "");
  EXPECT_EQ(did_you_mean("oracle", {"gibbs", "occlusion-aware"}, "; see there"), "; see there");
  EXPECT_EQ(did_you_mean("foo", {"info", "scan"}), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
  EXPECT_EQ(did_you_mean("in", {"m", "inch"}), "; did you mean 'inch'?") << "it begins so";
  EXPECT_EQ(did_you_mean("widht", {"seed", "sensor.width"}), "; did you mean 'sensor.width'?");
  EXPECT_EQ(did_you_mean("noise", {"seed", "sensor.range_noise"}), "; did you mean 'sensor.range_noise'?");
  EXPECT_EQ(did_you_mean("scna", {"score", "scan"}), "; did you mean 'scan'?");
}

TEST(Nearest, OfAKeyTheSectionOrAllButAWordMayBeLeftOut) {
  const std::vector<std::string> keys = {"gain",          "seed",
                                         "truth",         "every",
                                         "sensor.preset", "sensor.width",
                                         "map.hit",       "sensor.range_noise",
                                         "gibbs.sweeps",  "planner.gain_weight"};
  EXPECT_EQ(nearest("width", keys), "sensor.width");
  EXPECT_EQ(nearest("widht", keys), "sensor.width");
  EXPECT_EQ(nearest("sweep", keys), "gibbs.sweeps");
  EXPECT_EQ(nearest("noise", keys), "sensor.range_noise");
  EXPECT_EQ(nearest("sensor.noise", keys), "sensor.range_noise");
  EXPECT_EQ(nearest("gain.weight", keys), "planner.gain_weight");
  EXPECT_EQ(nearest("gains", keys), "gain");
}

TEST(Bounds, EndsAreIncludedOrNot) {
  EXPECT_TRUE(from_to(1, 2).allow(1) && from_to(1, 2).allow(2));
  EXPECT_FALSE(between(1, 2).allow(1) || between(1, 2).allow(2));
  EXPECT_TRUE(!over_to(1, 2).allow(1) && over_to(1, 2).allow(2));
  EXPECT_TRUE(zero_or(4, 9).allow(0) && !zero_or(4, 9).allow(3));
  EXPECT_TRUE(zero_or(4, 9).allow(4) && zero_or(4, 9).allow(9) && !zero_or(4, 9).allow(9.1));
  EXPECT_FALSE(from_to(1, 2).allow(0) || between(1, 2).allow(0) || over_to(1, 2).allow(0)) << "0 is not off here";
  for (const Bounds& bounds : {from_to(1, 2), between(-1, 2), over_to(1, 2), zero_or(1, 2)})
    EXPECT_FALSE(bounds.allow(std::nan("")) || bounds.allow(INFINITY) || bounds.allow(-INFINITY));
}

TEST(Bounds, AreToldInWords) {
  EXPECT_EQ(from_to(0.5, 10000).text("px"), "from 0.5 to 10000 px");
  EXPECT_EQ(between(0, 1).text(), "over 0 and below 1");
  EXPECT_EQ(over_to(0, 100).text("m"), "over 0 and at most 100 m");
  EXPECT_EQ(from_to(1e-5, 1).text("m"), "from 0.01 mm to 1 m");
  EXPECT_EQ(zero_or(4, 1e6).text(), "0 or from 4 to 1000000");
}

TEST(Setting, IsCheckedOnlyWhenItIsAskedTo) {
  int pixels = 5;
  Setting setting{"sensor.width", "px", "image width", &pixels, from_to(1, 10)};
  setting.set("11");  // as a part of a configuration that may be mended by what comes
  EXPECT_EQ(pixels, 11);
  try {
    setting.require_in_bounds();
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "sensor.width must be from 1 to 10 px, not 11");
  }
  EXPECT_EQ(setting.explanation(), "image width [px]");
}

TEST(Setting, ADecimalCommaIsMentionedWithThePointThatItTakes) {
  double value = 0;
  Setting setting{"map.resolution", "m", "voxel edge", &value};
  const auto complaint = [&](const char* text) -> std::string {
    try {
      setting.set(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const std::string taken = "map.resolution takes " + number_wanted("m");
  EXPECT_EQ(complaint("3,5 mm"), taken + ", not '3,5 mm'; did you mean '3.5 mm'?");
  EXPECT_EQ(complaint("1,000,5"), taken + ", not '1,000,5'");
  EXPECT_EQ(value, 0);
}

TEST(Setting, ItsLabelIsTheKeyInWords) {
  double value = 0;
  EXPECT_EQ((Setting{"sensor.range_noise", "m", "", &value}.label()), "range noise");
  EXPECT_EQ((Setting{"seed", "", "", &value}.label()), "seed");
}

}  // namespace
}  // namespace nextview
