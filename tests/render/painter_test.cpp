// Flat things by their pixels: frames, colour bars, letters on displays of any scale.
#include "ui/drawing/painter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ui/charts/page.hpp"

namespace nextview {
namespace {

constexpr int page_width = 260, page_height = 120;  // of the page [px]; a legend of usual width fits

/// The pixel `x` to the right and `y` up.
const std::uint8_t* pixel(const Image& page, int x, int y) {
  return &page.rgba[(std::size_t(page.height - 1 - y) * page.width + x) * 4];
}

/// Something was painted there: it is not the page's white.
bool painted(const Image& page, int x, int y) {
  const std::uint8_t* p = pixel(page, x, y);
  return std::min({p[0], p[1], p[2]}) < 250;
}

Image page_of(const std::function<void(Painter&)>& paint, double scale = 1.0) {
  return draw_page(int(page_width * scale), int(page_height * scale), [&](vtkContext2D& context) {
    Painter painter(context, scale);
    paint(painter);
  });
}

TEST(Painter, AFrameIsFourSidesWithNothingWithinOrOutside) {
  const Image page = page_of([](Painter& painter) { painter.frame(60, 30, 90, 50, theme::ink); });
  for (int y = 0; y < page_height; ++y)
    for (int x = 0; x < page_width; ++x) {
      // A line of one pixel between two of them may lie on both.
      const bool beyond = x < 59 || x > 151 || y < 29 || y > 81;
      const bool within = x > 61 && x < 148 && y > 31 && y < 78;
      if (beyond || within) {
        ASSERT_FALSE(painted(page, x, y)) << x << ", " << y;
      }
    }
  const auto on_line = [&](int x, int y, int dx, int dy) {
    return painted(page, x - dx, y - dy) || painted(page, x, y) || painted(page, x + dx, y + dy);
  };
  for (int x = 62; x < 148; ++x) {
    EXPECT_TRUE(on_line(x, 30, 0, 1)) << "bottom at " << x;
    EXPECT_TRUE(on_line(x, 80, 0, 1)) << "top at " << x;
  }
  for (int y = 32; y < 78; ++y) {
    EXPECT_TRUE(on_line(60, y, 1, 0)) << "left at " << y;
    EXPECT_TRUE(on_line(150, y, 1, 0)) << "right at " << y;
  }
}

/// Of a range alone: its bar begins 17 px beneath the legend's top and is 12 px high.
TEST(Painter, AColourBarGoesEvenlyFromTheLowEndToTheHighOne) {
  const ColourMap map = ColourMap::height();  // of the widest range of lightness
  const Image page = page_of([&](Painter& painter) {
    painter.legend(20, 100, {"", {}, Legend::Range{map, 0.0, 1.0, ""}});
  });
  constexpr int columns = int(usual_legend_width);
  // How far all is from the colours that belong there, or so many columns farther on [of 255].
  const auto off = [&](int from, int to, int shift) {
    double sum = 0;
    for (int i = from; i < to; ++i)
      for (int c = 0; c < 3; ++c)
        sum += std::abs(pixel(page, 20 + i, 89)[c] - 255 * map.at(double(i + shift) / (columns - 1))[std::size_t(c)]);
    return sum / (3 * (to - from));
  };
  // The frame lies on the outermost columns.
  for (const auto& [from, to] : {std::pair{2, 56}, {56, 112}, {112, columns - 2}}) {
    EXPECT_LT(off(from, to, 0), 0.6) << "but for rounding";
    EXPECT_LT(off(from, to, 0), off(from, to, 1)) << from;
    EXPECT_LT(off(from, to, 0), off(from, to, -1)) << from;
  }
  EXPECT_FALSE(painted(page, 20 + columns + 3, 89));
}

/// How many pixels of a row are painted in what a range's numbers are written in, from `from` on for `count`.
int ink(const Image& page, int from, int count) {
  int found = 0;
  for (int x = from; x < from + count; ++x)
    for (int y = 62; y < 80; ++y) found += painted(page, x, y);
  return found;
}

TEST(Painter, ARangeAroundNothingSaysWhereThatIs) {
  const auto middle_of = [](double low, double high) {
    const Image page = page_of([&](Painter& painter) {
      painter.legend(20, 100, {"", {}, Legend::Range{ColourMap::deviation(), low, high, ""}});
    });
    return ink(page, 20 + int(usual_legend_width) / 2 - 8, 16);
  };
  EXPECT_GT(middle_of(-1.0, 1.0), 0);
  EXPECT_EQ(middle_of(-1.0, 2.0), 0) << "it is not in the middle";
  EXPECT_EQ(middle_of(0.0, 1.0), 0);
}

/// Its ends' names leave the 0 between them alone, however long they are.
TEST(Painter, ARangeIsAsWideAsItsEndsNamesNeed) {
  const Legend legend{"", {}, Legend::Range{ColourMap::deviation(), -0.03, 0.03, "", "inside", "outside"}};
  int middle = 0;
  const Image page = page_of([&](Painter& painter) {
    middle = 20 + int(painter.legend_width(legend)) / 2;
    painter.legend(20, 100, legend);
  });
  EXPECT_GT(ink(page, middle - 4, 8), 0);
  EXPECT_EQ(ink(page, middle - 12, 7), 0);
  EXPECT_EQ(ink(page, middle + 5, 7), 0);
}

TEST(Painter, StripesLieOnTheirSwatchAndNowhereElse) {
  Legend legend{"", {{"name", {1.0, 0.9, 0.2}}}, {}};
  const auto draw = [&] { return page_of([&](Painter& painter) { painter.legend(20, 100, legend); }); };
  const Image plain = draw();
  legend.swatches[0].stripes = Colour{0.0, 0.0, 0.6};
  const Image striped = draw();
  int changed = 0;
  for (int y = 0; y < page_height; ++y)
    for (int x = 0; x < page_width; ++x) {
      if (std::equal(pixel(plain, x, y), pixel(plain, x, y) + 3, pixel(striped, x, y))) continue;
      ++changed;
      // The swatch is 13 px wide and high, and its legend's line 20 px.
      EXPECT_TRUE(x >= 19 && x <= 34 && y >= 80 && y <= 95) << x << ", " << y;
    }
  EXPECT_TRUE(changed > 13 * 13 / 5 && changed < 13 * 13) << changed << ": stripes, not a plain area";
}

TEST(Painter, LettersAreAsWideOnAnyDisplay) {
  const std::string words = "measured but undecided";
  for (const TextWeight weight : {TextWeight::regular, TextWeight::semi_bold}) {
    std::vector<double> widths;
    for (const double scale : {1.0, 1.5, 2.0, 3.0}) {
      double told = 0;
      const Image page = page_of(
          [&](Painter& painter) {
            told = painter.text_width(words, theme::small_text, weight);
            painter.text(10, 40, words, theme::small_text, theme::ink, weight);
          },
          scale);
      int last = 0, first = page.width;
      for (int y = 0; y < page.height; ++y)
        for (int x = 0; x < page.width; ++x)
          if (painted(page, x, y)) first = std::min(first, x), last = std::max(last, x);
      EXPECT_NEAR((last + 1 - first) / scale, told, 4.0) << "as it is drawn, without what is free around it";
      widths.push_back(told);
    }
    for (const double told : widths) EXPECT_NEAR(told, widths.front(), 0.04 * widths.front()) << "but for rounding";
  }
}

// VTK opens a font again after some thirty others, by what a text property says by then.
TEST(Painter, LettersKeepTheirWeightAfterManyOthers) {
  const Colour own{0.3127, 0.1711, 0.2903};  // which nothing else has
  const auto both = [&] {
    return page_of([&](Painter& painter) {
      painter.text(20, 60, "candidate 17", theme::small_text, own, TextWeight::semi_bold);
      painter.text(20, 20, "another", theme::small_text, theme::ink);
    });
  };
  const Image first = both();
  page_of([](Painter& painter) {
    for (int i = 0; i < 80; ++i) painter.text(20, 20, "many", 8 + i, theme::ink);
  });
  EXPECT_EQ(both(), first);
}

TEST(Painter, EndsOfARangeHaveTheDigitsThatTellThemApart) {
  EXPECT_EQ(range_end(-6.075e-05, 0.0311), "-0.0001");
  EXPECT_EQ(range_end(0.03102, 0.0311), "0.031");
  EXPECT_EQ(range_end(-1e-9, 1.0), "0");
  EXPECT_EQ(range_end(0.31461, 0.31461), "0.315");
  EXPECT_EQ(range_end(2090.4, 2052.0), "2090");
  EXPECT_EQ(range_end(1.25e-9, 1.25e-9), "1.25e-09");
  EXPECT_EQ(range_end(5.0, 0.0), "5");
}

TEST(Painter, ALegendIsAsWideAsItsWidestLine) {
  page_of([](Painter& painter) {
    const Legend usual{"short", {{"a", theme::free}}, {}};
    EXPECT_EQ(painter.legend_width(usual), usual_legend_width);
    const std::string words = "a name that is by far too long for a legend of usual width";
    const double length = painter.text_width(words, theme::small_text);
    EXPECT_GT(painter.legend_width({"short", {{"a", theme::free}, {words, theme::free}}, {}}), length);
    Legend titled{words, {}, Legend::Range{ColourMap::score(), 0.0, 1.0, ""}};
    const double title = painter.legend_width(titled);
    EXPECT_EQ(title, painter.text_width(words, theme::small_text, TextWeight::semi_bold));
    titled.range->unit = "nats";
    EXPECT_GT(painter.legend_width(titled), title) << "the unit stands behind it";
    titled.range->unit = "";
    titled.locked = true;
    EXPECT_GT(painter.legend_width(titled), title) << "the lock stands behind it";
  });
}

}  // namespace
}  // namespace nextview
