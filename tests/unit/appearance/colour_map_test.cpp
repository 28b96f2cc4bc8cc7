// Colours against published values of OKLab, and what each map promises of its ends.
#include "ui/appearance/colour_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nextview {
namespace {

Colour grey(double value) { return {value, value, value}; }

/// As CSS Color 4 has them, to the digits that it gives.
TEST(Lightness, IsThatOfOklab) {
  EXPECT_NEAR(lightness({1, 0, 0}), 0.62796, 1e-4);
  EXPECT_NEAR(lightness({0, 1, 0}), 0.86644, 1e-4);
  EXPECT_NEAR(lightness({0, 0, 1}), 0.45201, 1e-4);
  EXPECT_NEAR(lightness(grey(1)), 1.0, 1e-6);
  EXPECT_NEAR(lightness(grey(0)), 0.0, 1e-6);
}

/// Of a grey it is the cube root of the light that it gives: of sRGB, 0.5 gives 0.21404 of white's, 0.04 gives 1/323.
TEST(Lightness, OfAGreyIsTheCubeRootOfItsLight) {
  EXPECT_NEAR(lightness(grey(0.5)), std::cbrt(0.21404), 1e-4);
  EXPECT_NEAR(lightness(grey(0.04)), std::cbrt(1.0 / 323.0), 1e-4) << "dark ones are in proportion";
}

TEST(OnDark, PaperIsDarkAndInkIsLightAndGreyStaysGrey) {
  EXPECT_LT(lightness(on_dark(theme::paper)), 0.25);
  EXPECT_GT(lightness(on_dark(theme::ink)), 0.9);
  for (const double value : {0.2, 0.5, 0.8, 1.0}) {
    const Colour turned = on_dark(grey(value));
    EXPECT_NEAR(turned[0], turned[1], 1e-4);
    EXPECT_NEAR(turned[1], turned[2], 1e-4);
  }
}

/// Equal steps stay equal, the other way round and nearly as large.
TEST(OnDark, LightnessIsTurnedOverEvenly) {
  for (double a = 0.3, step = 0.1; a < 0.85; a += step) {
    const double before = lightness(grey(a + step)) - lightness(grey(a));
    const double after = lightness(on_dark(grey(a))) - lightness(on_dark(grey(a + step)));
    EXPECT_NEAR(after / before, 1.0, 0.03) << a;
  }
}

TEST(OnDark, ColoursKeepWhatTellsThemApart) {
  const Colour red{0.6, 0.3, 0.3}, green{0.3, 0.6, 0.3}, blue{0.3, 0.3, 0.6};
  EXPECT_GT(on_dark(red)[0], on_dark(red)[1] + 0.1);
  EXPECT_GT(on_dark(green)[1], on_dark(green)[2] + 0.1);
  EXPECT_GT(on_dark(blue)[2], on_dark(blue)[0] + 0.1);
  ASSERT_LT(lightness(blue), lightness(red));
  ASSERT_LT(lightness(red), lightness(green));
  EXPECT_GT(lightness(on_dark(blue)), lightness(on_dark(red)) + 0.03);
  EXPECT_GT(lightness(on_dark(red)), lightness(on_dark(green)) + 0.03);
}

const ColourMap maps[] = {ColourMap::score(),     ColourMap::contribution(), ColourMap::probability(),
                          ColourMap::deviation(), ColourMap::uncertainty(),  ColourMap::error(),
                          ColourMap::distance(),  ColourMap::height(),       ColourMap::order()};

TEST(ColourMap, LightnessGoesStraightFromEndToMiddleToEnd) {
  for (const ColourMap& map : maps)
    for (const double begin : {0.0, 0.5}) {
      const double from = lightness(map.at(begin)), to = lightness(map.at(begin + 0.5));
      EXPECT_GT(std::abs(to - from), 0.15) << "it is to be seen in grey print";
      for (const double share : {0.2, 0.4, 0.6, 0.8})  // colours that no display has are cut, by 0.02 at most
        EXPECT_NEAR(lightness(map.at(begin + 0.5 * share)), from + share * (to - from), 0.02);
    }
}

TEST(ColourMap, OnDarkPaperItsMostIsItsLightest) {
  for (const ColourMap& map : maps) {
    const ColourMap turned = map.on_dark();
    for (const double t : {0.0, 0.5})
      EXPECT_LT((lightness(map.at(t + 0.5)) - lightness(map.at(t))) *
                    (lightness(turned.at(t + 0.5)) - lightness(turned.at(t))),
                0.0);
  }
}

bool is_most(const Colour& colour, int channel) {
  return colour[channel] > colour[(channel + 1) % 3] && colour[channel] > colour[(channel + 2) % 3];
}
constexpr int red = 0, green = 1, blue = 2;

TEST(ColourMap, EachHasTheHuesThatItsMeaningAsksFor) {
  EXPECT_TRUE(is_most(ColourMap::score().at(1), blue));
  EXPECT_TRUE(is_most(ColourMap::contribution().at(1), red));
  EXPECT_TRUE(is_most(ColourMap::probability().at(0), blue)) << "free";
  EXPECT_TRUE(is_most(ColourMap::probability().at(1), red)) << "brown: occupied";
  EXPECT_TRUE(is_most(ColourMap::deviation().at(0), blue)) << "below";
  EXPECT_TRUE(is_most(ColourMap::deviation().at(1), red)) << "above";
  EXPECT_NEAR(ColourMap::deviation().at(0.5)[0], ColourMap::deviation().at(0.5)[2], 1e-3) << "grey: even";
  EXPECT_TRUE(is_most(ColourMap::uncertainty().at(1), blue));
  EXPECT_TRUE(is_most(ColourMap::error().at(1), red));
  EXPECT_LT(ColourMap::distance().at(0)[red], ColourMap::distance().at(0)[green]) << "teal: near";
  EXPECT_TRUE(is_most(ColourMap::distance().at(1), red)) << "far";
  EXPECT_TRUE(is_most(ColourMap::height().at(0), blue)) << "violet: low";
  EXPECT_TRUE(is_most(ColourMap::height().at(1), green)) << "high";
  EXPECT_TRUE(is_most(ColourMap::order().at(0), red)) << "gold: the first";
  EXPECT_TRUE(is_most(ColourMap::order().at(1), blue)) << "the last";
}

TEST(ColourMap, AValueLiesBetweenTheEndsOfItsRange) {
  const ColourMap map = ColourMap::height();
  EXPECT_EQ(map.at(-10, -10, 30), map.at(0));
  EXPECT_EQ(map.at(0, -10, 30), map.at(0.25));
  EXPECT_EQ(map.at(30, -10, 30), map.at(1));
  EXPECT_EQ(map.at(31, -10, 30), map.at(1)) << "and not beyond";
  EXPECT_EQ(map.at(-11, -10, 30), map.at(0));
  EXPECT_EQ(map.at(2, 2, 2), map.at(1));
  EXPECT_EQ(map.at(std::nan("")), map.at(0));
  EXPECT_NE(map.at(0.49), map.at(0.5)) << "both halves change";
  EXPECT_NE(map.at(0.51), map.at(0.5));
}

TEST(Mix, GoesFromOneToTheOther) {
  const Colour a{0.0, 0.5, 1.0}, b{1.0, 0.5, 0.5};
  EXPECT_EQ(mix(a, b, 0.0), a);
  EXPECT_EQ(mix(a, b, 1.0), b);
  EXPECT_EQ(mix(a, b, 0.25), (Colour{0.25, 0.5, 0.875}));
}

}  // namespace
}  // namespace nextview
