#include "core/planner/termination.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace nextview {
namespace {

ScanProgress under_way() {
  ScanProgress p;
  p.views = 5, p.coverage = 0.6, p.best_gain = 40, p.first_gain = 100;
  p.new_voxel_share = 0.02, p.entropy_drop_share = 0.03;
  return p;
}

TEST(Termination, GoesOnWhileNoCriterionIsMet) {
  EXPECT_EQ(termination_reason({}, under_way()), "");
  EXPECT_EQ(termination_reason({20, 0.7, 0.3, 0.01, 0.02}, under_way()), "");
}

TEST(Termination, OneViewIsNoViews) {
  TerminationConfig one;
  one.views = 1;
  ScanProgress progress = under_way();
  progress.views = 1;
  EXPECT_EQ(termination_reason(one, progress), "1 view taken");
}

TEST(Termination, EveryCriterionStopsForAReasonOfItsOwn) {
  TerminationConfig views, coverage, gain, new_voxels, slope;
  views.views = 5;
  coverage.coverage = 0.6;
  gain.gain = 0.41;
  new_voxels.new_voxels = 0.021;
  slope.entropy_slope = 0.031;
  std::set<std::string> reasons;
  for (const TerminationConfig& config : {views, coverage, gain, new_voxels, slope}) {
    const std::string reason = termination_reason(config, under_way());
    EXPECT_NE(reason, "");
    EXPECT_EQ(reason.find('\n'), std::string::npos);
    reasons.insert(reason);
  }
  ScanProgress none_left = under_way();
  none_left.candidates_left = false;
  reasons.insert(termination_reason({}, none_left));
  EXPECT_EQ(reasons.size(), 6u);
  EXPECT_FALSE(reasons.contains(""));
}

TEST(Termination, WithoutAPredictionNoSurfaceIsLeftForIt) {
  ScanProgress progress = under_way();
  const TerminationConfig config;  // the default stops
  EXPECT_EQ(termination_reason(config, progress), "");
  progress.surface_left = 0.0051;
  EXPECT_EQ(termination_reason(config, progress), "");
  progress.surface_left = 0.005;
  EXPECT_NE(termination_reason(config, progress).find("0.5 % of the surface"), std::string::npos);
  EXPECT_EQ(termination_reason({20, 0, 0, 0, 0, 0.0}, progress), "") << "off";
}

TEST(Termination, CriteriaAreMetAtTheirBounds) {
  const auto stops = [](auto set_config, auto set_progress) {
    TerminationConfig config;
    ScanProgress progress = under_way();
    set_config(config);
    set_progress(progress);
    return !termination_reason(config, progress).empty();
  };
  const auto keep = [](auto&) {};
  for (const auto& [views, expected] : {std::pair(4, false), {5, true}, {6, true}})
    EXPECT_EQ(stops([](auto& c) { c.views = 5; }, [n = views](auto& p) { p.views = n; }), expected) << views;
  for (const auto& [coverage, expected] : {std::pair(0.899, false), {0.9, true}, {0.95, true}})
    EXPECT_EQ(stops([](auto& c) { c.coverage = 0.9; }, [x = coverage](auto& p) { p.coverage = x; }), expected);
  for (const auto& [gain, expected] : {std::pair(10.1, false), {10.0, true}, {0.0, true}})
    EXPECT_EQ(stops([](auto& c) { c.gain = 0.1; }, [x = gain](auto& p) { p.best_gain = x; }), expected) << gain;
  EXPECT_FALSE(stops([](auto& c) { c.new_voxels = 0.02; }, keep));  // "less than"
  EXPECT_FALSE(stops([](auto& c) { c.entropy_slope = 0.03; }, keep));
}

TEST(Termination, AtZeroACriterionIsOff) {
  ScanProgress p;
  p.views = 3, p.coverage = 0, p.best_gain = 0, p.first_gain = 0, p.new_voxel_share = 0, p.entropy_drop_share = 0;
  EXPECT_EQ(termination_reason({}, p), "");
}

TEST(Termination, AnEntropyThatRoseIsASlopeBelowTheBound) {
  TerminationConfig config;
  config.entropy_slope = 0.001;
  ScanProgress p = under_way();
  p.entropy_drop_share = -0.01;
  EXPECT_NE(termination_reason(config, p), "");
}

TEST(Termination, RejectsWhatMakesNoSense) {
  const auto rejects = [](auto change, const std::string& field) {
    TerminationConfig config;
    change(config);
    try {
      config.validate();
      ADD_FAILURE() << field;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  EXPECT_NO_THROW(TerminationConfig().validate());
  rejects([](auto& c) { c.views = 0; }, "views");
  rejects([](auto& c) { c.views = -1; }, "views");
  for (const double bad : {-0.1, 1.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    rejects([&](auto& c) { c.coverage = bad; }, "coverage");
    rejects([&](auto& c) { c.gain = bad; }, "gain");
    rejects([&](auto& c) { c.new_voxels = bad; }, "new_voxels");
    rejects([&](auto& c) { c.entropy_slope = bad; }, "entropy_slope");
  }
}

}  // namespace
}  // namespace nextview
