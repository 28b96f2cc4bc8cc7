#include "core/calibration/sensor_model_calibration.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/unit/calibration/simulated_histories.hpp"

namespace nextview {
namespace {

using namespace simulated_histories;

void expect_model(const InverseSensorModel& found, const InverseSensorModel& known, double tolerance) {
  EXPECT_NEAR(found.hit, known.hit, tolerance);
  EXPECT_NEAR(found.miss, known.miss, tolerance);
  EXPECT_NEAR(found.clamp_min, known.clamp_min, tolerance);
  EXPECT_NEAR(found.clamp_max, known.clamp_max, tolerance);
  EXPECT_NEAR(found.hit_decay, known.hit_decay, 10.0 * tolerance);
  EXPECT_NEAR(found.miss_decay, known.miss_decay, 10.0 * tolerance);
}

TEST(Calibration, FindsTheModelThatMadeTheTargets) {
  for (const InverseSensorModel& known : {model(0.82, 0.33, 0.07, 0.93), model(0.65, 0.44, 0.2, 0.9)}) {
    const Calibration fit = calibrate(histories(scans(20), known), {});
    expect_model(fit.model, known, 1e-4);
    EXPECT_LT(fit.cross_entropy, fit.cross_entropy_before);
    EXPECT_FALSE(fit.termination.empty());
  }
}

TEST(Calibration, FindsTheDecaysToo) {
  const InverseSensorModel known = model(0.82, 0.33, 0.05, 0.95, 0.7, -0.4);
  const UpdateHistories all = histories(scans(20), known);
  CalibrationConfig config;
  const Calibration without = calibrate(all, {}, config);
  config.range_dependent = true;
  const Calibration with = calibrate(all, {}, config);
  expect_model(with.model, known, 1e-4);
  EXPECT_LT(with.cross_entropy, without.cross_entropy - 1e-4);
  EXPECT_FALSE(without.model.range_dependent());
}

TEST(Calibration, LeavesAloneWhatIsNotFitted) {
  InverseSensorModel start = model(0.7, 0.4, 0.1, 0.95, 0.3, 0.2);
  start.occupancy_threshold = 0.6, start.free_below = 0.15, start.occupied_above = 0.85;
  CalibrationConfig config;
  config.clamps = false;
  const InverseSensorModel found = calibrate(histories(scans(6), model(0.8, 0.3, 0.1, 0.9)), start, config).model;
  EXPECT_NE(found.hit, start.hit);
  EXPECT_NE(found.miss, start.miss);
  InverseSensorModel expected = start;
  expected.hit = found.hit, expected.miss = found.miss;
  EXPECT_EQ(found, expected);
}

// Targets at the ends, which no model within the bounds reaches; and clamps that the threshold must stay between.
TEST(Calibration, AModelAtTheBoundsIsStillValid) {
  const std::vector<Scan> views = scans(6);
  for (const float everywhere_target : {0.0f, 0.5f, 1.0f}) {
    UpdateHistories all;
    const std::vector<float> target(grid().voxel_count(), everywhere_target);
    all.add(grid(), views, target, everywhere());
    for (const double threshold : {0.3, 0.5, 0.8}) {
      InverseSensorModel start;
      start.occupancy_threshold = threshold;
      CalibrationConfig config;
      config.range_dependent = true;
      config.iterations = 30;
      const Calibration fit = calibrate(all, start, config);
      EXPECT_NO_THROW(fit.model.validate()) << everywhere_target << " " << threshold;
      EXPECT_LE(fit.cross_entropy, fit.cross_entropy_before);
      EXPECT_NEAR(all.cross_entropy(fit.model).value, fit.cross_entropy, 1e-12);
    }
  }
}

TEST(Calibration, NeverEndsWithAHigherCrossEntropyThanItBegan) {
  const UpdateHistories all = histories(scans(8), model(0.75, 0.35, 0.1, 0.9));
  for (const InverseSensorModel& start : {InverseSensorModel(), model(0.75, 0.35, 0.1, 0.9),
                                          model(0.999999, 1e-6, 1e-6, 1 - 1e-6), model(0.5001, 0.4999, 0.499, 0.501)})
    for (const bool clamps : {false, true}) {
      CalibrationConfig config;
      config.clamps = clamps;
      const Calibration fit = calibrate(all, start, config);
      EXPECT_NEAR(fit.cross_entropy_before, all.cross_entropy(start).value, 1e-12);
      EXPECT_LE(fit.cross_entropy, fit.cross_entropy_before);
      EXPECT_NEAR(all.cross_entropy(fit.model).value, fit.cross_entropy, 1e-12);
    }
}

TEST(Calibration, TheDescentGoesDownAndEndsAtTheModel) {
  const Calibration fit = calibrate(histories(scans(10), model(0.85, 0.3, 0.05, 0.95)), {});
  ASSERT_GT(fit.descent.size(), 3u);
  for (std::size_t i = 1; i < fit.descent.size(); ++i)
    EXPECT_LE(fit.descent[i].cross_entropy, fit.descent[i - 1].cross_entropy) << i;
  EXPECT_EQ(fit.descent.back().model, fit.model);
  EXPECT_EQ(fit.descent.back().cross_entropy, fit.cross_entropy);
  EXPECT_TRUE(fit.converged) << fit.termination;
  EXPECT_LT(fit.descent.back().gradient_norm, 1e-3 * fit.descent.front().gradient_norm);
}

// Clamps so narrow that each term alone goes from one to the other: neither half nor twice the terms are any better.
TEST(Calibration, WhereNothingIsGainedTheGivenModelStays) {
  const InverseSensorModel start = model(0.7, 0.4, 0.48, 0.52);
  CalibrationConfig config;
  config.clamps = false;
  const Calibration fit = calibrate(histories(scans(4), model(0.8, 0.3, 0.1, 0.9)), start, config);
  EXPECT_EQ(fit.model, start);
  EXPECT_EQ(fit.cross_entropy, fit.cross_entropy_before);
  EXPECT_TRUE(fit.termination.starts_with("from the given terms: ")) << fit.termination;
  EXPECT_TRUE(fit.converged) << "the gradient is 0";
}

TEST(Calibration, TheStartThatWonIsNamedAndItsDescentBeginsThere) {
  const std::map<std::string, double> scales = {
      {"from the given terms", 1.0}, {"from half the terms", 0.5}, {"from twice the terms", 2.0}};
  const UpdateHistories all = histories(scans(8), model(0.75, 0.35, 0.1, 0.9));
  for (const InverseSensorModel& start :
       {model(0.7, 0.4, 0.12, 0.97), model(0.98, 0.03, 0.12, 0.97), model(0.55, 0.47, 0.12, 0.97)}) {
    const Calibration fit = calibrate(all, start);
    const std::string name = fit.termination.substr(0, fit.termination.find(':'));
    ASSERT_TRUE(scales.contains(name)) << fit.termination;
    ASSERT_FALSE(fit.descent.empty());
    const InverseSensorModel& first = fit.descent.front().model;
    EXPECT_NEAR(log_odds(first.hit), scales.at(name) * log_odds(start.hit), 1e-9);
    EXPECT_NEAR(log_odds(first.miss), scales.at(name) * log_odds(start.miss), 1e-9);
    EXPECT_NEAR(all.cross_entropy(first).value, fit.descent.front().cross_entropy, 1e-12);
  }
}

TEST(Calibration, ItsProgressGoesFromStartToStart) {
  CalibrationConfig config;
  config.iterations = 10;
  std::vector<double> told;
  calibrate(histories(scans(4), model(0.85, 0.3, 0.05, 0.95)), {}, config, [&](double fraction, std::string_view what) {
    told.push_back(fraction);
    EXPECT_EQ(what, "fitting the inverse sensor model");
  });
  ASSERT_GT(told.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_LT(told.front(), 1.0 / 3.0) << "two more starts follow";
  EXPECT_GT(told.back(), 2.0 / 3.0) << "two starts are done";
  EXPECT_LE(told.back(), 1.0);
}

TEST(Calibration, IterationsAreKeptTo) {
  CalibrationConfig config;
  config.iterations = 2;
  const Calibration fit = calibrate(histories(scans(6), model(0.85, 0.3, 0.05, 0.95)), {}, config);
  EXPECT_LE(fit.descent.size(), 3u);
  EXPECT_FALSE(fit.converged);
  EXPECT_NE(fit.termination.find("iterations"), std::string::npos) << fit.termination;
  EXPECT_FALSE(fit.termination.ends_with('.')) << "what prints it ends the sentence";
  config.iterations = 0;
  EXPECT_THROW(calibrate(histories(scans(1), {}), {}, config), std::invalid_argument);
}

TEST(Calibration, AStopKeepsTheBestSoFar) {
  const UpdateHistories all = histories(scans(6), model(0.85, 0.3, 0.05, 0.95));
  std::stop_source source;
  int calls = 0;
  const auto stop_at_third = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    if (++calls == 3) source.request_stop();
  };
  const Calibration fit = calibrate(all, {}, {}, stop_at_third, source.get_token());
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(fit.termination, "stopped");
  EXPECT_FALSE(fit.converged);
  EXPECT_LT(fit.cross_entropy, fit.cross_entropy_before);

  const Calibration none = calibrate(all, {}, {}, {}, source.get_token());  // stopped before it begins
  EXPECT_EQ(none.model, InverseSensorModel());
  EXPECT_EQ(none.termination, "stopped");
}

TEST(Calibration, SaysNothingOnStandardError) {
  testing::internal::CaptureStderr();
  const UpdateHistories all = histories(scans(6), model(0.99, 0.02, 0.12, 0.97));
  std::stop_source stopped;
  stopped.request_stop();
  calibrate(all, model(0.999, 0.001, 0.12, 0.97));  // on a plateau
  calibrate(all, {}, {.clamps = false, .range_dependent = true, .iterations = 20});
  calibrate(all, {}, {}, {}, stopped.get_token());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Calibration, TheSameBytesOnOneThreadAndTwo) {
  const UpdateHistories all = histories(scans(8), model(0.82, 0.33, 0.05, 0.95, 0.7, -0.4));
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return calibrate(all, {}, {.clamps = true, .range_dependent = true, .iterations = 40});
  };
  const Calibration one = run(1), two = run(2);
  EXPECT_EQ(one.model, two.model);
  EXPECT_EQ(one.cross_entropy, two.cross_entropy);
  EXPECT_EQ(one.termination, two.termination);
  EXPECT_EQ(one.descent.size(), two.descent.size());
}

TEST(Calibration, BadInputIsRefused) {
  EXPECT_THROW(calibrate({}, {}), std::invalid_argument);  // no histories
  const UpdateHistories all = histories(scans(1), {});
  EXPECT_THROW(calibrate(all, model(0.4, 0.3, 0.1, 0.9)), std::invalid_argument);
  InverseSensorModel sure = model(0.7, 0.4, 0.1, 0.99999);
  sure.occupancy_threshold = 0.9999;
  EXPECT_THROW(calibrate(all, sure), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
