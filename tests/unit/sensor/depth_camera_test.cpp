#include "core/sensor/depth_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "core/mesh/parts.hpp"
#include "tests/unit/sensor/plane_scene.hpp"

namespace nextview {
namespace {

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
      {"outliers", [](auto& c) { c.outliers = -0.1; }},
      {"outliers", [](auto& c) { c.outliers = 1.1; }},
      {"outliers", [&](auto& c) { c.outliers = nan; }},
      {"grazing_limit", [](auto& c) { c.grazing_limit = 91; }}};
  for (const auto& [field, change] : wrong) {
    DepthCameraConfig config;
    change(config);
    try {
      const DepthCamera camera(config);
      ADD_FAILURE() << field;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(field));
      EXPECT_THAT(error.what(), testing::ContainsRegex("must be (from|at most sensor.max_range)"));
    }
  }
  EXPECT_NO_THROW(DepthCamera(DepthCameraConfig{}));
}

TEST(DepthCamera, imagesHaveAnythingFromOnePixelTo16384ASide) {
  const auto is_taken = [](int width, int height) {
    DepthCameraConfig config;
    config.width = width, config.height = height;
    try {
      config.validate();
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  };
  for (const auto& [width, height] : {std::pair(1, 1), {1, 16384}, {16384, 1}}) EXPECT_TRUE(is_taken(width, height));
  for (const auto& [width, height] : {std::pair(0, 1), {1, 0}, {16385, 1}, {1, 16385}})
    EXPECT_FALSE(is_taken(width, height)) << width << " x " << height;
  DepthCameraConfig one;
  one.width = one.height = 1;
  const DepthImage image = DepthCamera(one).sense_ideal(MeshRayCaster(plane({0, 0, 1}, {0, 0, 1})), Pose::Identity());
  ASSERT_EQ(image.range.size(), 1u);
  EXPECT_NEAR(image.range[0], 1.0, 1e-6) << "straight ahead";
}

TEST(DepthCamera, intrinsicsTakeThePlaceOfTheFieldOfView) {
  DepthCameraConfig config;
  const PinholeCamera plain = config.camera();
  EXPECT_EQ(plain.fx, PinholeCamera::from_field_of_view(640, 480, 58.0 * std::numbers::pi / 180.0).fx);
  config.intrinsics = "448.1 450, 376.5 -2";
  const PinholeCamera camera = DepthCamera(config).camera();
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx, 448.1);
  EXPECT_EQ(camera.fy, 450.0);
  EXPECT_EQ(camera.cx, 376.5);
  EXPECT_EQ(camera.cy, -2.0);
  for (const char* wrong : {"448", "0 448 1 1", "448 -448 1 1", "448 448 1 1 1", "448 448 1 x", "nan 448 1 1",
                            "448 inf 1 1", "1e7 448 1 1", "448 448 1 -1e7", " "}) {
    config.intrinsics = wrong;
    EXPECT_THROW(config.validate(), std::invalid_argument) << wrong;
  }
}

TEST(DepthCamera, aTiltedPlaneHasTheRangesOfTheFormula) {
  DepthCameraConfig config;
  config.width = 37, config.height = 23;  // no multiples of a packet
  config.max_range = 100.0;
  const Vector3 point(0.3, 0.4, -0.5), normal = Vector3(1, 2, 5).normalized();
  const Pose T_world_camera = look_at({0.8, 1.1, 0.6}, point);
  const DepthImage image = DepthCamera(config).sense_ideal(MeshRayCaster(plane(point, normal)), T_world_camera);
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
  const DepthImage image = DepthCamera(config).sense_ideal(MeshRayCaster(sphere_part().mesh), T_world_camera);
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

TEST(DepthCamera, theSameBytesOnAnyNumberOfThreads) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  config.dropout = 0.1;
  config.outliers = 0.1;
  const TriangleMesh mesh = slotted_housing().mesh;
  const Pose T_world_camera = look_at({0.4, -0.5, 0.5}, Vector3::Zero());
  std::vector<DepthImage> images;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(DepthCamera(config).sense(MeshRayCaster(mesh), T_world_camera, 42, 7));
  }
  EXPECT_TRUE(same_bytes(images[0], images[1]));
  EXPECT_TRUE(same_bytes(images[0], images[2]));
}

TEST(DepthCamera, surfacesMetAtMoreThanTheGrazingLimitAreInvalid) {
  DepthCameraConfig config;
  config.width = 320, config.height = 240;
  config.grazing_limit = 70.0, config.range_noise = 0.0, config.max_range = 100.0;
  const Vector3 normal(0, std::sin(55 * degree), -std::cos(55 * degree));  // met at 33 to 77 degrees over the height
  const MeshRayCaster scene(plane({0, 0, 2}, normal));
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
  const MeshRayCaster scene(plane({0, 0, 1}, normal));
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

TEST(DepthCamera, anInsideOutMeshLooksTheSame) {
  TriangleMesh mesh = slotted_housing().mesh;
  const DepthCamera camera{DepthCameraConfig{}};
  const Pose T_world_camera = look_at({0.5, 0.5, 0.6}, Vector3::Zero());
  const DepthImage outside = camera.sense(MeshRayCaster(mesh), T_world_camera, 1, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 1 + t % 2)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const DepthImage mixed = camera.sense(MeshRayCaster(mesh), T_world_camera, 1, 1);
  for (std::size_t i = 0; i < outside.range.size(); ++i) {
    ASSERT_EQ(std::isnan(outside.range[i]), std::isnan(mixed.range[i]));
    if (!DepthImage::is_range(outside.range[i])) continue;
    ASSERT_NEAR(outside.range[i], mixed.range[i], 1e-6);
  }
}

}  // namespace
}  // namespace nextview
