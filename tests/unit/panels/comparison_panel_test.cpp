#include "ui/panels/comparison_panel.hpp"

#include <gtest/gtest.h>

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
