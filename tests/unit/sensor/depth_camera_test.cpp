#include "core/sensor/depth_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "core/mesh/parts.hpp"

namespace nextview {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A square 20 m wide through `point` across `normal`.
TriangleMesh plane(const Vector3& point, const Vector3& normal) {
  const Vector3 u = 10.0 * normal.unitOrthogonal(), v = normal.normalized().cross(u);
  TriangleMesh mesh;
  for (const Vector3& corner :
       {Vector3(point - u - v), Vector3(point + u - v), Vector3(point + u + v), Vector3(point - u + v)})
    mesh.vertices.push_back(corner.cast<float>());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Calls `check(pixel's index, its unit ray in the camera frame)` for all pixels, from the pinhole equation itself.
void for_each_pixel(const DepthCameraConfig& config, const std::function<void(std::size_t, const Vector3&)>& check) {
  const double focal_length = 0.5 * config.width / std::tan(0.5 * config.field_of_view * degree);
  for (int v = 0; v < config.height; ++v)
    for (int u = 0; u < config.width; ++u) {
      const Vector3 d(u - 0.5 * (config.width - 1), v - 0.5 * (config.height - 1), focal_length);
      check(std::size_t(v) * config.width + u, d.normalized());
    }
}

double below(double deviations) { return 0.5 * std::erfc(-deviations / std::sqrt(2.0)); }

bool same_bytes(const DepthImage& a, const DepthImage& b) {
  return a.range.size() == b.range.size() && std::memcmp(a.range.data(), b.range.data(), 4 * a.range.size()) == 0;
}

TEST(DepthCamera, settingsOutsideTheirBoundsAreNamed) {
  const double nan = std::nan("");
  const std::vector<std::pair<const char*, std::function<void(DepthCameraConfig&)>>> wrong = {
      {"width", [](auto& c) { c.width = 0; }},
      {"height", [](auto& c) { c.height = -3; }},
      {"height", [](auto& c) { c.height = 1 << 20; }},
      {"field_of_view", [](auto& c) { c.field_of_view = 180; }},
      {"min_range", [](auto& c) { c.min_range = 2; }},
      {"min_range", [](auto& c) { c.min_range = -1; }},
      {"max_range", [&](auto& c) { c.max_range = nan; }},
      {"range_noise", [](auto& c) { c.range_noise = -0.1; }},
      {"range_noise", [&](auto& c) { c.range_noise = nan; }},
      {"dropout", [](auto& c) { c.dropout = 1.1; }},
      {"grazing_limit", [](auto& c) { c.grazing_limit = 91; }}};
  for (const auto& [field, change] : wrong) {
    DepthCameraConfig config;
    change(config);
    try {
      const DepthCamera camera(config);
      ADD_FAILURE() << field;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(field));
      EXPECT_THAT(error.what(), testing::HasSubstr("between"));
    }
  }
  EXPECT_NO_THROW(DepthCamera(DepthCameraConfig{}));
}

TEST(DepthCamera, aTiltedPlaneHasTheRangesOfTheFormula) {
  DepthCameraConfig config;
  config.width = 37, config.height = 23;  // no multiples of a packet
  config.max_range = 100.0;
  const Vector3 point(0.3, 0.4, -0.5), normal = Vector3(1, 2, 5).normalized();
  const Pose T_world_camera = look_at({0.8, 1.1, 0.6}, point);
  const DepthImage image = DepthCamera(config).sense_ideal(RayScene(plane(point, normal)), T_world_camera);
  ASSERT_EQ(image.range.size(), 37u * 23u);
  EXPECT_EQ(image.camera.width, 37);
  for_each_pixel(config, [&](std::size_t pixel, const Vector3& ray) {
    const Vector3 d = T_world_camera.linear() * ray;
    const double range = normal.dot(point - T_world_camera.translation()) / normal.dot(d);
    ASSERT_NEAR(image.range[pixel], range, 2e-6) << pixel;
  });
}

TEST(DepthCamera, aSphereHasItsOutlineAndItsDepth) {
  DepthCameraConfig config;
  config.width = 160, config.height = 121;
  const Pose T_world_camera = look_at({0.5, -0.6, 0.4}, Vector3::Zero());
  const double distance = T_world_camera.translation().norm();
  const DepthImage image = DepthCamera(config).sense_ideal(RayScene(sphere_part().mesh), T_world_camera);
  int hits = 0, misses = 0;
  for_each_pixel(config, [&](std::size_t pixel, const Vector3& ray) {
    const double towards = distance * ray.z(), off_axis = distance * std::hypot(ray.x(), ray.y());
    if (off_axis > 0.25) {
      ++misses;
      ASSERT_TRUE(DepthImage::is_beyond_range(image.range[pixel]));
    } else if (off_axis < 0.249) {
      ++hits;
      // The facets lie up to 72 micrometres inside the sphere.
      ASSERT_GE(image.range[pixel], towards - std::sqrt(0.25 * 0.25 - off_axis * off_axis) - 1e-6);
      ASSERT_LE(image.range[pixel], towards - std::sqrt(0.24992 * 0.24992 - off_axis * off_axis) + 1e-6);
    }
  });
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 2000);
}

/// What the noise of one view adds to every pixel, in standard deviations.
std::vector<double> noise(const DepthCameraConfig& config, std::uint64_t seed, std::uint32_t view_index) {
  const DepthCamera camera(config);
  const RayScene scene(plane({0, 0, 1}, {0.2, 0, 1}));
  const DepthImage ideal = camera.sense_ideal(scene, Pose::Identity());
  const DepthImage noisy = camera.sense(scene, Pose::Identity(), seed, view_index);
  std::vector<double> deviations;
  for (std::size_t i = 0; i < ideal.range.size(); ++i)
    deviations.push_back((double(noisy.range[i]) - ideal.range[i]) / config.range_noise);
  return deviations;
}

TEST(DepthCamera, noiseIsGaussianAndIndependentBetweenPixels) {
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

TEST(DepthCamera, seedAndViewChooseTheNoise) {
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

TEST(DepthCamera, theSameBytesOnAnyNumberOfThreads) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  config.dropout = 0.1;
  const TriangleMesh mesh = slotted_housing().mesh;
  const Pose T_world_camera = look_at({0.4, -0.5, 0.5}, Vector3::Zero());
  std::vector<DepthImage> images;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(DepthCamera(config).sense(RayScene(mesh), T_world_camera, 42, 7));
  }
  EXPECT_TRUE(same_bytes(images[0], images[1]));
  EXPECT_TRUE(same_bytes(images[0], images[2]));
}

TEST(DepthCamera, surfacesMetAtMoreThanTheGrazingLimitAreInvalid) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  config.grazing_limit = 70.0, config.range_noise = 0.0, config.max_range = 100.0;
  const Vector3 normal(0, std::sin(55 * degree), -std::cos(55 * degree));  // met at 33 to 77 degrees over the height
  const RayScene scene(plane({0, 0, 2}, normal));
  const DepthImage image = DepthCamera(config).sense(scene, Pose::Identity(), 1, 0);
  const DepthImage ideal = DepthCamera(config).sense_ideal(scene, Pose::Identity());
  int valid = 0, invalid = 0;
  for_each_pixel(config, [&](std::size_t pixel, const Vector3& ray) {
    const double angle = std::acos(std::abs(normal.dot(ray))) / degree;
    if (std::abs(angle - 70.0) < 0.01 || !DepthImage::is_range(ideal.range[pixel])) return;
    ASSERT_EQ(std::isnan(image.range[pixel]), angle > 70.0) << angle;
    (angle > 70.0 ? invalid : valid)++;
  });
  EXPECT_GT(valid, 3'000);
  EXPECT_GT(invalid, 3'000);
}

TEST(DepthCamera, rangesBeyondTheLimitsAreBeyondRangeOrInvalid) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  config.range_noise = 0.0, config.min_range = 0.9, config.max_range = 1.2;
  const DepthCamera camera(config);
  const Vector3 normal = Vector3(0.5, 0, 1).normalized();
  const RayScene scene(plane({0, 0, 1}, normal));
  std::array<int, 3> counts{};
  for (const DepthImage& image :
       {camera.sense(scene, Pose::Identity(), 1, 0), camera.sense_ideal(scene, Pose::Identity())})
    for_each_pixel(config, [&](std::size_t pixel, const Vector3& ray) {
      const double range = normal.z() / normal.dot(ray);
      const float r = image.range[pixel];
      if (std::abs(range - 0.9) < 1e-5 || std::abs(range - 1.2) < 1e-5) return;
      ASSERT_EQ(std::isnan(r), range < 0.9) << range;
      ASSERT_EQ(DepthImage::is_beyond_range(r), range > 1.2) << range;
      ++counts[DepthImage::is_range(r) ? 0 : std::isnan(r) ? 1 : 2];
    });
  for (const int count : counts) EXPECT_GT(count, 3'000);
}

/// The noise comes first: a surface just beyond the maximum range is seen now and then, one just before it missed now
/// and then.
TEST(DepthCamera, noiseDecidesAtTheLimits) {
  DepthCameraConfig config;
  config.width = 160, config.height = 120;
  config.field_of_view = 2.0, config.min_range = 0.5;
  for (const double deviations : {-1.0, 0.0, 1.0, 2.0}) {
    for (const bool at_max : {true, false}) {
      const double distance = (at_max ? config.max_range : config.min_range) + deviations * config.range_noise;
      const RayScene scene(plane({0, 0, distance}, {0, 0, 1}));
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

TEST(DepthCamera, dropoutTakesItsShareAndLeavesTheRestAlone) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  const RayScene scene(sphere_part().mesh);
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

TEST(DepthCamera, anInsideOutMeshLooksTheSame) {
  TriangleMesh mesh = slotted_housing().mesh;
  const DepthCamera camera{DepthCameraConfig{}};
  const Pose T_world_camera = look_at({0.5, 0.5, 0.6}, Vector3::Zero());
  const DepthImage outside = camera.sense(RayScene(mesh), T_world_camera, 1, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 1 + t % 2)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const DepthImage mixed = camera.sense(RayScene(mesh), T_world_camera, 1, 1);
  for (std::size_t i = 0; i < outside.range.size(); ++i) {
    ASSERT_EQ(std::isnan(outside.range[i]), std::isnan(mixed.range[i]));
    if (!DepthImage::is_range(outside.range[i])) continue;
    ASSERT_NEAR(outside.range[i], mixed.range[i], 1e-6);
  }
}

}  // namespace
}  // namespace nextview
