#include "ui/panels/comparison_panel.hpp"

#include <gtest/gtest.h>

#include "tests/unit/panels/made_scan.hpp"

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

}  // namespace
}  // namespace nextview
