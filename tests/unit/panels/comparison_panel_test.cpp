#include "ui/panels/comparison_panel.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

TEST(Comparison, TellsSettingsFromWhatCameOfThem) {
  const auto here = made_scan(), there = made_scan();
  there->configuration.termination.views = here->configuration.termination.views + 1;
  const auto rows = differences(*here, *there);
  EXPECT_EQ(rows.at(0).name, "termination.views");
  EXPECT_EQ(rows.at(1).name, "views");
  EXPECT_EQ(rows.at(1).here, "2");
}

TEST(Comparison, PathsHaveOneUnit) {
  const auto here = made_scan(), there = made_scan();
  here->state.known.map = there->state.known.map = OccupancyMap(region_of_interest(Vector3::Zero(), 0.05, 0.001));
  here->records[0].motion.distance = there->records[0].motion.distance = 0;
  here->records[1].motion.distance = 1.25;
  there->records[1].motion.distance = 0.5;
  const auto rows = differences(*here, *there);
  const auto path = std::ranges::find(rows, "path", &Difference::name);
  ASSERT_NE(path, rows.end());
  EXPECT_EQ(path->here, "1250 mm");
  EXPECT_EQ(path->there, "500 mm");
}

TEST(Comparison, WhatIsComparedIsReadWholeInANarrowPanel) {
  Desk desk(1100, 800);
  open_all_ways(desk);
  ASSERT_TRUE(desk.snapshot->compared);
  desk.window.bring_to_front("comparison");
  desk.frames();
  ASSERT_NE(read("Compare"), "");
  for (const SeenText& cut : cut_texts()) EXPECT_NE(cut.window, "Compare") << cut.text;
}

}  // namespace
}  // namespace nextview
