#include "core/gibbs/range_measurements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

std::size_t total_weight(const RangeMeasurements& measurements) {
  return std::accumulate(measurements.rays.begin(), measurements.rays.end(), std::size_t{0},
                         [](std::size_t sum, const RangeMeasurement& ray) { return sum + ray.weight; });
}

/// Two cameras that look at a bumpy wall, densely; every fifth ray misses it, some hits are outliers.
RangeMeasurements dense_rays() {
  RangeMeasurements measurements;
  measurements.origins = {{0.0, 0.0, 0.0}, {0.3, 0.1, -0.2}};
  const CounterRandom random(3, 998);
  for (std::uint32_t i = 0; i < 4'000; ++i) {
    const auto u = random.uniform(i);
    RangeMeasurement ray;
    ray.origin = i % 2;
    ray.beyond_range = i % 5 == 0;
    ray.weight = static_cast<std::uint16_t>(1 + i % 3);
    const Vector3 direction = Vector3(u[0] - 0.5, u[1] - 0.5, 1.0).normalized();
    const double range = ray.beyond_range ? measurements.max_range : i % 50 == 1 ? 0.2 + u[2] : 1.0 + 0.01 * u[2];
    ray.end = (measurements.origins[ray.origin] + range * direction).cast<float>();
    measurements.rays.push_back(ray);
  }
  return measurements;
}

TEST(RangeMeasurements, afterIsWhatWasAppended) {
  const RangeMeasurements earlier = dense_rays();
  RangeMeasurements later = dense_rays();
  later.rays.resize(100);
  RangeMeasurements both = earlier;
  both.append(later);
  const RangeMeasurements after = both.after(earlier);
  EXPECT_EQ(after.max_range, later.max_range);
  EXPECT_EQ(after.origins, later.origins);
  ASSERT_EQ(after.rays.size(), later.rays.size());
  for (std::size_t k = 0; k < later.rays.size(); ++k) {
    EXPECT_EQ(after.rays[k].origin, later.rays[k].origin);
    EXPECT_EQ(after.rays[k].end, later.rays[k].end);
    EXPECT_EQ(after.rays[k].weight, later.rays[k].weight);
  }
  EXPECT_TRUE(both.after(both).rays.empty());
}

TEST(RangeMeasurements, addTakesReturnsAndPassesOfEachScan) {
  RangeMeasurements measurements;
  measurements.add({{0, 0, 0}, {{0, 0, 1}, {0.5, 0, 0}}, {{0, 1.5f, 0}}});
  measurements.add({{1, 0, 0}, {{1, 0, 1}}, {}});
  ASSERT_EQ(measurements.origins.size(), 2u);
  ASSERT_EQ(measurements.rays.size(), 4u);
  EXPECT_EQ(total_weight(measurements), 4u);
  EXPECT_EQ(std::count_if(measurements.rays.begin(), measurements.rays.end(),
                          [](const auto& ray) { return ray.beyond_range; }),
            1);
  const RangeMeasurement& last = measurements.rays.back();
  EXPECT_EQ(measurements.origins.at(last.origin), Vector3(1, 0, 0));
  EXPECT_NEAR(measurements.range(last), 1.0, 1e-6);
  EXPECT_NEAR((measurements.direction(last) - Vector3(0, 0, 1)).norm(), 0.0, 1e-6);
}

TEST(RangeMeasurements, addTakesReturnsBeyondTheMaximumRangeForNoReturns) {
  RangeMeasurements measurements;
  measurements.max_range = 1.0;
  measurements.add({{0, 0, 0}, {{0, 0, 0.9f}, {0, 0, 1.1f}, {0, 0, 7}}, {}});
  ASSERT_EQ(measurements.rays.size(), 3u);
  EXPECT_FALSE(measurements.rays[0].beyond_range);
  for (const int far : {1, 2}) {
    EXPECT_TRUE(measurements.rays[far].beyond_range);
    EXPECT_EQ(measurements.range(measurements.rays[far]), 1.0);
  }
}

TEST(RangeMeasurements, addLeavesOutWhatHasNoDirection) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  RangeMeasurements measurements;
  measurements.add({{1, 2, 3}, {{1, 2, 3}, {1, 2, 4}, {nan, 2, 4}}, {{1, 2, 3}, {1, nan, 3}}});
  ASSERT_EQ(measurements.rays.size(), 1u);
  EXPECT_NEAR(measurements.range(measurements.rays[0]), 1.0, 1e-6);
}

TEST(MergeRays, noSpacingChangesNothing) {
  const RangeMeasurements measurements = dense_rays();
  const RangeMeasurements merged = merge_rays(measurements, 0.0, 0.1);
  ASSERT_EQ(merged.rays.size(), measurements.rays.size());
  for (std::size_t i = 0; i < merged.rays.size(); ++i) {
    EXPECT_EQ(merged.rays[i].end, measurements.rays[i].end);
    EXPECT_EQ(merged.rays[i].origin, measurements.rays[i].origin);
    EXPECT_EQ(merged.rays[i].weight, measurements.rays[i].weight);
    EXPECT_EQ(merged.rays[i].beyond_range, measurements.rays[i].beyond_range);
  }
  EXPECT_EQ(merged.origins, measurements.origins);
  EXPECT_EQ(merged.max_range, measurements.max_range);
}

TEST(MergeRays, keepsTheWeightOfEachOriginAndKind) {
  const RangeMeasurements measurements = dense_rays();
  const RangeMeasurements merged = merge_rays(measurements, 0.05, 0.02);
  EXPECT_LT(merged.rays.size(), measurements.rays.size() / 2) << "few were merged";
  const auto weight = [&](const RangeMeasurements& all, std::uint32_t origin, bool beyond_range) {
    std::size_t sum = 0;
    for (const RangeMeasurement& ray : all.rays)
      if (all.origins[ray.origin] == measurements.origins[origin] && ray.beyond_range == beyond_range)
        sum += ray.weight;
    return sum;
  };
  for (const std::uint32_t origin : {0u, 1u})
    for (const bool beyond_range : {false, true})
      EXPECT_EQ(weight(merged, origin, beyond_range), weight(measurements, origin, beyond_range));
  EXPECT_EQ(total_weight(merged), total_weight(measurements));
}

TEST(MergeRays, everyRayHasAJoinedOneBesideIt) {
  constexpr double spacing = 0.03, spread = 0.02;
  const RangeMeasurements measurements = dense_rays(), merged = merge_rays(measurements, spacing, spread);
  for (std::size_t i = 0; i < measurements.rays.size(); i += 7) {
    const RangeMeasurement& ray = measurements.rays[i];
    const bool found = std::any_of(merged.rays.begin(), merged.rays.end(), [&](const RangeMeasurement& other) {
      return other.beyond_range == ray.beyond_range &&
             merged.origins[other.origin] == measurements.origins[ray.origin] &&
             measurements.direction(ray).dot(merged.direction(other)) > std::cos(2.0 * spacing) &&
             std::abs(merged.range(other) - measurements.range(ray)) <= spread;
    });
    ASSERT_TRUE(found) << "range " << measurements.range(ray);
  }
}

TEST(MergeRays, theMergedRayIsTheWeightedMean) {
  RangeMeasurements measurements;
  measurements.origins = {{0, 0, 0}};
  measurements.rays = {{{0.13f, 0.14f, 1.0f}, 0, 1},
                       {{0.1304f, 0.1404f, 1.004f}, 0, 3},
                       {{-0.83f, 0.37f, 0.61f}, 0, 9}};  // far from the two
  const RangeMeasurements merged = merge_rays(measurements, 0.1, 0.01);
  ASSERT_EQ(merged.rays.size(), 2u);
  const RangeMeasurement& mean = merged.rays[merged.rays[0].weight == 9 ? 1 : 0];
  EXPECT_EQ(mean.weight, 4);
  EXPECT_NEAR(mean.end.x(), 0.1303, 1e-5);
  EXPECT_NEAR(mean.end.y(), 0.1403, 1e-5);
  EXPECT_NEAR(mean.end.z(), 1.003, 1e-5);
}

TEST(MergeRays, anOutlierIsNotAveragedIn) {
  RangeMeasurements measurements;
  measurements.origins = {{0, 0, 0}};
  for (int i = 0; i < 10; ++i) measurements.rays.push_back({{0.0f, 0.0f, 1.0f}});
  measurements.rays.insert(measurements.rays.begin() + 4, {{0.0f, 0.0f, 0.5f}});
  const RangeMeasurements merged = merge_rays(measurements, 0.1, 0.01);
  ASSERT_EQ(merged.rays.size(), 2u);
  for (const RangeMeasurement& ray : merged.rays) {
    EXPECT_NEAR(merged.range(ray), ray.weight == 10 ? 1.0 : 0.5, 1e-6);
    EXPECT_TRUE(ray.weight == 10 || ray.weight == 1);
  }
}

TEST(MergeRays, rangesOfAJoinedRayAreWithinTheSpread) {
  RangeMeasurements measurements;  // a ladder: neighbours are near, ends are not
  measurements.origins = {{0, 0, 0}};
  for (int i = 0; i <= 100; ++i) measurements.rays.push_back({{0.0f, 0.0f, 1.0f + 0.001f * static_cast<float>(i)}});
  const RangeMeasurements merged = merge_rays(measurements, 0.1, 0.0105);
  EXPECT_GE(merged.rays.size(), 10u) << "11 steps of 1 mm fit into 10.5 mm";
  EXPECT_LE(merged.rays.size(), 30u);
  for (const RangeMeasurement& ray : merged.rays) EXPECT_LE(ray.weight, 11);
}

TEST(MergeRays, opposedDirectionsStayApart) {
  RangeMeasurements measurements;
  measurements.origins = {{0, 0, 0}};
  for (const Eigen::Vector3f& end : {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(-1, 0, 0), Eigen::Vector3f(0, 1, 0),
                                     Eigen::Vector3f(0, -1, 0), Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1)})
    measurements.rays.push_back({end});
  EXPECT_EQ(merge_rays(measurements, 0.5, 0.1).rays.size(), 6u);
}

// Up to 60 degrees from the middle of what a camera sees, cells are squares of one plane across it, 1 m off: of a disc,
// as many merged rays as squares reach into it. Whichever way the camera looks.
TEST(MergeRays, cellsAreSquaresAcrossTheMiddleOfWhatIsSeen) {
  constexpr double spacing = 0.2, step = 0.02;
  const double radius = std::tan(59.0 * std::numbers::pi / 180.0), squares = radius / spacing;
  // Those within, and those that a circle cuts: 4 / pi a length of a square's side on average.
  const double expected = std::numbers::pi * squares * squares + 4.0 * squares;
  for (const Vector3& towards : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0.48, -0.6, 0.64)}) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), towards);
    RangeMeasurements measurements;
    measurements.origins = {{0, 0, 0}};
    const int reach = static_cast<int>(radius / step);
    for (int i = -reach; i <= reach; ++i)
      for (int k = -reach; k <= reach; ++k)
        if (std::hypot(i * step, k * step) <= radius)
          measurements.rays.push_back({(turn * Vector3(i * step, k * step, 1.0).normalized()).cast<float>()});
    const auto merged = static_cast<double>(merge_rays(measurements, spacing, 0.1).rays.size());
    EXPECT_NEAR(merged, expected, 0.05 * expected) << towards.transpose();
  }
}

TEST(MergeRays, cellsBehindTheCameraAreNotThoseBeforeIt) {
  RangeMeasurements measurements;
  measurements.origins = {{0, 0, 0}};
  for (int turn = 0; turn < 8; ++turn) {  // on a circle around the mean direction, and two opposed ones nearby
    const double angle = (turn + 0.5) * std::numbers::pi / 4.0;
    for (const double z : {0.3, -0.3})
      measurements.rays.push_back({Vector3(std::cos(angle), std::sin(angle), z).normalized().cast<float>()});
    measurements.rays.push_back({{0.0f, 0.0f, 1.0f}});
  }
  const RangeMeasurements merged = merge_rays(measurements, 0.25, 0.1);
  EXPECT_EQ(merged.rays.size(), 17u) << "the eight alike are one";
}

TEST(MergeRays, aHundredThousandRaysKeepTheirWeight) {
  RangeMeasurements measurements;  // more than a weight of 16 bits can say
  measurements.origins = {{0, 0, 0}};
  measurements.rays.assign(100'000, {{0.0f, 0.0f, 1.0f}});
  const RangeMeasurements merged = merge_rays(measurements, 0.1, 0.01);
  EXPECT_EQ(total_weight(merged), 100'000u);
  EXPECT_LE(merged.rays.size(), 4u);
}

TEST(MergeRays, ofNothingIsNothing) { EXPECT_TRUE(merge_rays({}, 0.1, 0.01).rays.empty()); }

}  // namespace
}  // namespace nextview
