#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/mesh/parts.hpp"
#include "core/sensor/depth_camera.hpp"
#include "tests/unit/sensor/plane_scene.hpp"

namespace nextview {
namespace {

/// Share of a standard normal variable below so many standard deviations.
double below(double deviations) { return 0.5 * std::erfc(-deviations / std::sqrt(2.0)); }

/// What the noise of one view adds to every pixel, in standard deviations.
std::vector<double> noise(const DepthCameraConfig& config, std::uint64_t seed, std::uint32_t view_index) {
  const DepthCamera camera(config);
  const MeshRayCaster scene(plane({0, 0, 1}, {0.2, 0, 1}));
  const DepthImage ideal = camera.sense_ideal(scene, Pose::Identity());
  const DepthImage noisy = camera.sense(scene, Pose::Identity(), seed, view_index);
  std::vector<double> deviations;
  for (std::size_t i = 0; i < ideal.range.size(); ++i)
    deviations.push_back((double(noisy.range[i]) - ideal.range[i]) / config.range_noise);
  return deviations;
}

TEST(DepthNoise, noiseIsGaussianAndIndependentBetweenPixels) {
  DepthCameraConfig config;
  config.max_range = 100.0;
  const std::vector<double> z = noise(config, 11, 3);
  const double n = static_cast<double>(z.size());
  double sum = 0, squares = 0, within_one = 0, beyond_three = 0, right = 0, down = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    ASSERT_TRUE(std::isfinite(z[i]));
    sum += z[i], squares += z[i] * z[i];
    within_one += std::abs(z[i])<1, beyond_three += std::abs(z[i])> 3;
    right += z[i] * z[(i + 1) % z.size()], down += z[i] * z[(i + config.width) % z.size()];
  }
  constexpr double sigmas = 4.0;  // of the Monte-Carlo error
  EXPECT_NEAR(sum / n, 0.0, sigmas / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 1.0, sigmas / std::sqrt(2 * n));
  const double p1 = 1 - 2 * below(-1), p3 = 2 * below(-3);
  EXPECT_NEAR(within_one / n, p1, sigmas * std::sqrt(p1 * (1 - p1) / n));
  EXPECT_NEAR(beyond_three / n, p3, sigmas * std::sqrt(p3 * (1 - p3) / n));
  EXPECT_NEAR(right / n, 0.0, sigmas / std::sqrt(n));
  EXPECT_NEAR(down / n, 0.0, sigmas / std::sqrt(n));
}

TEST(DepthNoise, seedAndViewChooseTheNoise) {
  DepthCameraConfig config;
  config.width = 100, config.height = 100, config.max_range = 100.0;
  const std::vector<double> first = noise(config, 1, 0);
  EXPECT_EQ(first, noise(config, 1, 0));
  for (const std::vector<double>& other : {noise(config, 2, 0), noise(config, 1, 1)}) {
    double correlation = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) correlation += first[i] * other[i] / 1e4;
    EXPECT_NEAR(correlation, 0.0, 4.0 / 100.0);
  }
}

/// The noise comes first: a surface just beyond the maximum range is seen now and then, one just before it missed now
/// and then.
TEST(DepthNoise, noiseDecidesAtTheLimits) {
  DepthCameraConfig config;
  config.width = 160, config.height = 120;
  config.field_of_view = 2.0, config.min_range = 0.5;
  for (const double deviations : {-1.0, 0.0, 1.0, 2.0}) {
    for (const bool at_max : {true, false}) {
      const double distance = (at_max ? config.max_range : config.min_range) + deviations * config.range_noise;
      const MeshRayCaster scene(plane({0, 0, distance}, {0, 0, 1}));
      const DepthImage image = DepthCamera(config).sense(scene, Pose::Identity(), 5, 0);
      double expected = 0, found = 0;
      for_each_pixel(config, [&](std::size_t pixel, const Vector3& ray) {
        const float r = image.range[pixel];
        ASSERT_EQ(std::isnan(r), !DepthImage::is_range(r) && !at_max);
        if (DepthImage::is_range(r)) {
          ASSERT_LE(r, config.max_range);
          ASSERT_GE(r, config.min_range);
        }
        found += DepthImage::is_range(r);
        const double beyond =
            (distance / ray.z() - (at_max ? config.max_range : config.min_range)) / config.range_noise;
        expected += below(at_max ? -beyond : beyond);
      });
      EXPECT_NEAR(found, expected, 4.0 * 0.5 * std::sqrt(image.range.size())) << deviations << at_max;
    }
  }
}

TEST(DepthNoise, dropoutTakesItsShareAndLeavesTheRestAlone) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  const MeshRayCaster scene(sphere_part().mesh);
  const Pose T_world_camera = look_at({0.9, 0, 0}, Vector3::Zero());
  const DepthImage whole = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  config.dropout = 0.3;
  const DepthImage image = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  const DepthImage ideal = DepthCamera(config).sense_ideal(scene, T_world_camera);
  double squares = 0.0, left = 0.0;           // of the noise of what is left
  std::array<double, 2> pixels{}, dropped{};  // hits, misses
  for (std::size_t i = 0; i < whole.range.size(); ++i) {
    if (std::isnan(whole.range[i])) continue;
    const int kind = DepthImage::is_beyond_range(whole.range[i]);
    ++pixels[kind];
    dropped[kind] += std::isnan(image.range[i]);
    ASSERT_TRUE(std::isnan(image.range[i]) || image.range[i] == whole.range[i]);
    if (!DepthImage::is_range(image.range[i])) continue;
    squares += std::pow((image.range[i] - ideal.range[i]) / config.range_noise, 2), ++left;
  }
  for (int kind = 0; kind < 2; ++kind) {
    EXPECT_GT(pixels[kind], 3'000);
    EXPECT_NEAR(dropped[kind] / pixels[kind], 0.3, 4.0 * std::sqrt(0.3 * 0.7 / pixels[kind])) << kind;
  }
  // Who is dropped has nothing to do with the noise.
  EXPECT_NEAR(squares / left, 1.0, 4.0 * std::sqrt(2.0 / left));
  config.dropout = 1.0;
  for (const float r : DepthCamera(config).sense(scene, T_world_camera, 9, 2).range) ASSERT_TRUE(std::isnan(r));
}

/// Kolmogorov and Smirnov's distance between numbers and an even spread from `lowest` to `highest`.
double distance_to_uniform(std::vector<float> values, double lowest, double highest) {
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = (values[i] - lowest) / (highest - lowest), below_it = static_cast<double>(i) / n;
    distance = std::max({distance, std::abs(expected - below_it), std::abs(expected - below_it - 1.0 / n)});
  }
  return distance;
}

TEST(DepthNoise, outliersReplaceTheirShareOfEveryKindOfPixelAndLeaveTheRestAlone) {
  DepthCameraConfig config;
  config.width = 640, config.height = 480, config.grazing_limit = 60.0;  // so that many pixels are invalid
  config.min_range = 0.3, config.max_range = 1.3;
  const MeshRayCaster scene(sphere_part().mesh);
  const Pose T_world_camera = look_at({0.7, 0, 0}, Vector3::Zero());
  const DepthImage without = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  config.outliers = 0.2;
  const DepthImage image = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  std::array<double, 3> pixels{};              // ranges, beyond range, invalid
  std::array<std::vector<float>, 3> outliers;  // what they became
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    const float before = without.range[i], after = image.range[i];
    const int kind = std::isnan(before) ? 2 : DepthImage::is_beyond_range(before);
    ++pixels[kind];
    if (std::memcmp(&before, &after, sizeof(float)) == 0) continue;
    ASSERT_GE(after, 0.3f);
    ASSERT_LE(after, 1.3f);
    outliers[kind].push_back(after);
  }
  for (int kind = 0; kind < 3; ++kind) {
    ASSERT_GT(pixels[kind], 10'000) << kind;
    const auto found = static_cast<double>(outliers[kind].size());
    EXPECT_NEAR(found / pixels[kind], 0.2, 4.0 * std::sqrt(0.2 * 0.8 / pixels[kind])) << kind;
    EXPECT_LT(distance_to_uniform(outliers[kind], 0.3, 1.3), 2.2 / std::sqrt(found)) << kind;
  }
}

TEST(DepthNoise, seedAndViewChooseTheOutliers) {
  DepthCameraConfig config;
  config.width = 100, config.height = 100, config.outliers = 0.5;
  const DepthCamera camera(config);
  const MeshRayCaster nothing(plane({0, 0, 9}, {0, 0, 1}));
  const auto ranges = [&](std::uint64_t seed, std::uint32_t view) {
    return camera.sense(nothing, Pose::Identity(), seed, view).range;
  };
  const std::vector<float> first = ranges(1, 0);
  EXPECT_EQ(first, ranges(1, 0));
  for (const std::vector<float>& other : {ranges(2, 0), ranges(1, 1)}) {
    double both = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      both += DepthImage::is_range(first[i]) && DepthImage::is_range(other[i]);
      ASSERT_TRUE(first[i] != other[i] || DepthImage::is_beyond_range(first[i]));
    }
    EXPECT_NEAR(both / 1e4, 0.25, 4.0 * std::sqrt(0.25 * 0.75 / 1e4));
  }
}

TEST(DepthNoise, aPixelThatDropsOutIsNoOutlier) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240, config.dropout = 0.3;
  const MeshRayCaster scene(sphere_part().mesh);
  const Pose T_world_camera = look_at({0.9, 0, 0}, Vector3::Zero());
  config.grazing_limit = 90.0;  // only dropout makes pixels invalid
  const DepthImage dropped = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  config.outliers = 1.0;
  const DepthImage image = DepthCamera(config).sense(scene, T_world_camera, 9, 2);
  int count = 0;
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    ASSERT_EQ(std::isnan(image.range[i]), std::isnan(dropped.range[i]));
    ASSERT_FALSE(DepthImage::is_beyond_range(image.range[i]));
    count += std::isnan(image.range[i]);
  }
  EXPECT_NEAR(count, 0.3 * 320 * 240, 1000);
}

}  // namespace
}  // namespace nextview
