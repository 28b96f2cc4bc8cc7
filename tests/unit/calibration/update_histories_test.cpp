#include "core/calibration/update_histories.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>

#include "tests/unit/calibration/simulated_histories.hpp"

namespace nextview {
namespace {

using namespace simulated_histories;

const std::vector<InverseSensorModel> models = {
    {},
    model(0.99, 0.02, 0.12, 0.97),                // each beyond the clamps at once
    model(0.6, 0.45, 0.3, 0.75),                  // often at the clamps
    model(0.8, 0.35, 1e-4, 1 - 1e-4, 0.9, -0.6),  // hardly ever
    model(0.85, 0.3, 0.2, 0.9, -1.5, 1.2),
};

TEST(UpdateHistories, PredictWhatTheOccupancyMapHolds) {
  const std::vector<Scan> views = scans(12);
  for (const InverseSensorModel& m : models) {
    const OccupancyMap expected = map(views, m);
    const std::vector<double> p = histories(views, {}).probabilities(m);
    std::size_t n = 0;
    for (const Voxel& v : expected.voxels())
      if (v.measured) {
        ASSERT_LT(n, p.size());
        ASSERT_NEAR(p[n++], v.probability, 2e-6);
      }
    EXPECT_EQ(n, p.size());
    EXPECT_GT(n, 10'000u);
  }
}

TEST(UpdateHistories, CrossEntropyIsTheMeanOverVoxels) {
  const std::vector<Scan> views = scans(6);
  const OccupancyMap held = map(views, {});
  const std::vector<float> target = probabilities(map(views, models[2]));
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < target.size(); ++v) {
    if (!held.voxels()[v].measured) continue;
    const double p = probability(held.log_odds(v)), g = target[v];
    sum -= g * std::log(p) + (1.0 - g) * std::log(1.0 - p);
    ++count;
  }
  const UpdateHistories all = histories(views, models[2]);
  EXPECT_EQ(all.voxels(), count);
  EXPECT_NEAR(all.cross_entropy({}).value, sum / double(count), 1e-6);
}

// By log-odds and by decays, through clamps that act and clamps that do not.
TEST(UpdateHistories, GradientIsThatOfFiniteDifferences) {
  const UpdateHistories all = histories(scans(12), models[4]);
  for (const InverseSensorModel& m : {models[2], models[3], models[4], model(0.71, 0.41, 0.123, 0.957, 0.13, 0.21)}) {
    const std::array<double InverseSensorModel::*, sensor_parameters> fields = {
        &InverseSensorModel::hit,       &InverseSensorModel::miss,      &InverseSensorModel::clamp_min,
        &InverseSensorModel::clamp_max, &InverseSensorModel::hit_decay, &InverseSensorModel::miss_decay};
    const CrossEntropy at = all.cross_entropy(m);
    for (std::size_t k = 0; k < sensor_parameters; ++k) {
      const double step = 1e-6;
      const auto moved = [&](double by) {
        InverseSensorModel other = m;
        double& field = other.*fields[k];
        field = k < 4 ? probability(log_odds(field) + by) : field + by;
        return all.cross_entropy(other).value;
      };
      EXPECT_NEAR(at.gradient[k], (moved(step) - moved(-step)) / (2.0 * step), 2e-6) << k;
    }
  }
}

TEST(UpdateHistories, WithoutRangesTheSameForModelsWithoutDecays) {
  const UpdateHistories all = histories(scans(12), models[3]), merged = all.without_ranges();
  EXPECT_EQ(merged.voxels(), all.voxels());
  EXPECT_LT(merged.probabilities({}).size(), all.voxels() / 5);
  for (const InverseSensorModel& m : {models[0], models[1], models[2]}) {
    const CrossEntropy a = all.cross_entropy(m), b = merged.cross_entropy(m);
    EXPECT_NEAR(a.value, b.value, 1e-12);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(a.gradient[k], b.gradient[k], 1e-12) << k;
  }
}

TEST(UpdateHistories, SetsWeighAsTheirVoxels) {
  UpdateHistories both;
  double sum = 0.0;
  for (const int count : {2, 9}) {
    const std::vector<Scan> views = scans(count);
    const std::vector<float> target = probabilities(map(views, models[2]));
    both.add(grid(), views, target, everywhere());
    const UpdateHistories alone = histories(views, models[2]);
    sum += alone.cross_entropy({}).value * double(alone.voxels());
  }
  EXPECT_NEAR(both.cross_entropy({}).value, sum / double(both.voxels()), 1e-12);
}

TEST(UpdateHistories, OnlyVoxelsOfTheMaskAreKept) {
  const std::vector<Scan> views = scans(3);
  const OccupancyMap held = map(views, {});
  std::vector<std::uint8_t> mask(grid().voxel_count());
  std::vector<float> target(grid().voxel_count(), std::nanf(""));  // nobody asks for a target outside of the mask
  std::size_t expected = 0;
  for (std::size_t v = 0; v < mask.size(); v += 7) {
    mask[v] = 1;
    target[v] = 0.25f;
    expected += held.voxels()[v].measured;
  }
  UpdateHistories some;
  some.add(grid(), views, target, mask);
  EXPECT_EQ(some.voxels(), expected);
  EXPECT_GT(expected, 500u);
}

TEST(UpdateHistories, BadInputIsRefusedAndAddsNothing) {
  UpdateHistories none;
  EXPECT_THROW(none.cross_entropy({}), std::invalid_argument);
  const std::vector<Scan> views = scans(1);
  const std::vector<float> good(grid().voxel_count(), 0.5f);
  const auto rejects = [&](std::span<const float> target, std::span<const std::uint8_t> mask) {
    EXPECT_THROW(none.add(grid(), views, target, mask), std::invalid_argument);
  };
  for (const float bad : {-0.01f, 1.01f, std::nanf(""), INFINITY}) {
    auto target = good;
    target[4321] = bad;
    rejects(target, everywhere());
  }
  rejects(std::span(good).first(10), everywhere());
  rejects(good, std::vector<std::uint8_t>(10, 1));
  for (const double range : {0.0, -1.0, std::nan("")}) {
    std::vector<Scan> out_of_bounds = scans(2);
    out_of_bounds[1].max_range = range;
    EXPECT_THROW(none.add(grid(), out_of_bounds, good, everywhere()), std::invalid_argument) << range;
  }
  EXPECT_EQ(none.voxels(), 0u);
  none.add(grid(), {}, good, everywhere());  // no scans, no histories
  EXPECT_EQ(none.voxels(), 0u);
}

TEST(UpdateHistories, AModelThatIsNoneIsRefused) {
  const UpdateHistories all = histories(scans(1), {});
  for (const InverseSensorModel& bad :
       {model(0.4, 0.4, 0.1, 0.9), model(0.7, 0.6, 0.1, 0.9), model(0.7, 0.4, 0.6, 0.9), model(0.7, 0.4, 0.1, 0.4)}) {
    EXPECT_THROW(all.cross_entropy(bad), std::invalid_argument);
    EXPECT_THROW(all.probabilities(bad), std::invalid_argument);
  }
}

// Of several places, as of finished scans and objects: each brings its own grid and scans.
TEST(UpdateHistories, AppendedOnesAreAsIfAddedThemselves) {
  UpdateHistories appended = histories(scans(3), models[2]);
  const UpdateHistories more = histories(scans(4, 5), models[2]);
  std::vector<double> expected = appended.probabilities({});
  const std::vector<double> of_more = more.probabilities({});
  expected.insert(expected.end(), of_more.begin(), of_more.end());
  const std::size_t voxels = appended.voxels() + more.voxels();
  appended.append(more);
  EXPECT_EQ(appended.voxels(), voxels);
  EXPECT_EQ(appended.probabilities({}), expected);
}

TEST(UpdateHistories, TheSameBytesOnOneThreadAndTwo) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return histories(scans(8), models[4]).cross_entropy(models[3]);
  };
  const CrossEntropy one = run(1), two = run(2);
  EXPECT_EQ(one.value, two.value);
  EXPECT_EQ(one.gradient, two.gradient);
}

}  // namespace
}  // namespace nextview
