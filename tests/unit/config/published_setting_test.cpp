#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/configuration.hpp"

namespace nextview {
namespace {

/// What is wrong with a configuration with this setting; empty if nothing is.
std::string complaint(const std::string& key, const std::string& text, const std::string& resolution = "") {
  Configuration c;
  try {
    if (!resolution.empty()) give(c, "map.resolution", resolution, "map.resolution");
    give(c, key, text, key);
    c.validate();
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(PublishedSetting, DefaultsAreWhatWasBefore) {
  const Configuration c;
  EXPECT_TRUE(c.object.centred);
  EXPECT_FALSE(c.object.ground);
  EXPECT_EQ(c.sensor.intrinsics, "");
  EXPECT_EQ(c.map.region, "");
  EXPECT_EQ(c.planner.ray_window, 1.0);
  EXPECT_EQ(c.planner.start_view, "");
  EXPECT_EQ(c.evaluation.samples, EvaluationSamples::surface);
  EXPECT_EQ(c.map.region_box().min(), Vector3::Constant(-0.64));
  EXPECT_EQ(c.map.region_box().max(), Vector3::Constant(0.64));
}

TEST(PublishedSetting, BoundsAreKept) {
  using testing::HasSubstr;
  EXPECT_EQ(complaint("map.region", "-0.4 -0.4 0 0.4 0.4 0.8"), "");
  EXPECT_EQ(complaint("map.region", "0.4,0.4,0.8, -0.4,-0.4,0"), "") << "corners in any order";
  for (const char* bad : {"1", "0 0 0 1 1 0", "0 0 0 1 1 nan", "5000 0 0 5001 1 1"})
    EXPECT_THAT(complaint("map.region", bad), HasSubstr("map.region")) << bad;
  for (const char* bad : {"0 0 0 1 1 10.3", "0 0 0 1 1 0.001"}) {
    EXPECT_EQ(complaint("map.region", bad), "") << "may suit the voxels that the object will have";
    EXPECT_THAT(complaint("map.region", bad, "0.01"), HasSubstr("map.region")) << bad;
  }
  EXPECT_EQ(complaint("planner.start_view", "-0.6 0 0.35 0 -0.70710678 0 -0.70710678"), "");
  for (const char* bad : {"1 2 3", "0 0 0 0 0 0 0", "x"})
    EXPECT_THAT(complaint("planner.start_view", bad), HasSubstr("planner.start_view")) << bad;
  EXPECT_EQ(complaint("planner.ray_window", "0.5"), "");
  for (const char* bad : {"0", "1.1", "-1", "nan"})
    EXPECT_THAT(complaint("planner.ray_window", bad), HasSubstr("planner.ray_window")) << bad;
  EXPECT_EQ(complaint("sensor.intrinsics", "448.1 448.1 376 240"), "");
  EXPECT_THAT(complaint("sensor.intrinsics", "448.1"), HasSubstr("sensor.intrinsics"));
  EXPECT_THAT(complaint("evaluation.samples", "edges"), HasSubstr("evaluation.samples"));
}

TEST(PublishedSetting, TheRegionsLimitsAreThoseOfVoxels) {
  Configuration c;
  c.map.region = "0 0 0 10.24 0.01 1";
  EXPECT_NO_THROW(c.validate());
  c.map.resolution = 0.009;
  EXPECT_THROW(c.validate(), std::invalid_argument) << "more than 1024 of them";
  c.map.region_edge = 100;
  c.map.resolution = 0.01;
  EXPECT_NO_THROW(c.validate()) << "the cube's edge plays no part";
}

TEST(PublishedSetting, RayPitchFollowsTheIntrinsics) {
  DepthCameraConfig sensor;
  EXPECT_NEAR(ray_pitch(sensor), 58.0 * 3.14159265358979 / 180 / 640, 1e-12);
  sensor.intrinsics = "500 500 319.5 239.5";
  EXPECT_EQ(ray_pitch(sensor), 1.0 / 500);
}

TEST(PublishedSetting, TheCommittedConfigurationIsThePublishedOne) {
  const Configuration c =
      read_configuration(std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/configurations/published_bunny.toml");
  const PinholeCamera camera = c.sensor.camera();
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx, 448.1);
  EXPECT_EQ(camera.cx, 376.0);
  EXPECT_EQ(c.map.region_box().min(), Vector3(-0.4, -0.4, 0.0));
  EXPECT_EQ(c.map.region_box().max(), Vector3(0.4, 0.4, 0.8));
  const Pose start = parse_view(c.planner.start_view);
  EXPECT_EQ(start.translation(), Vector3(-0.6, 0.0, 0.35));
  EXPECT_LT((start.linear().col(2) - Vector3::UnitX()).norm(), 1e-8);
  EXPECT_EQ(c.planner.weights.cost, 0.0);
}

}  // namespace
}  // namespace nextview
