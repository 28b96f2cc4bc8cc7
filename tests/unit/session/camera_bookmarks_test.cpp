#include "core/session/camera_bookmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

CameraBookmark camera(const std::string& name, double angle) {
  CameraBookmark result{name};
  result.T_world_camera.translation() = Vector3(angle, -2, 0.5);
  result.T_world_camera.linear() = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  return result;
}

class CameraBookmarks : public testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(folder_.path() / cameras_name) << text; }
  std::string error() {
    try {
      read_cameras(folder_.path());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST_F(CameraBookmarks, AreReadAsTheyWereWritten) {
  EXPECT_TRUE(read_cameras(folder_.path()).empty());
  std::vector<CameraBookmark> cameras;
  for (const auto& [name, angle] : {std::pair("front \"left\"", 0.3), {"später", 2.9}})
    keep(cameras, camera(name, angle));
  write(cameras_json(cameras));
  const auto read = read_cameras(folder_.path());
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].name, cameras[i].name);
    EXPECT_TRUE(read[i].T_world_camera.isApprox(cameras[i].T_world_camera, 1e-12));
  }
}

TEST_F(CameraBookmarks, OneNameIsOneCamera) {
  std::vector<CameraBookmark> cameras;
  keep(cameras, camera("a", 1));
  keep(cameras, camera("b", 2));
  keep(cameras, camera("a", 3));
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].T_world_camera.translation().x(), 3);
  forget(cameras, "a");
  EXPECT_EQ(cameras.size(), 1u);
  EXPECT_THROW(forget(cameras, "a"), std::invalid_argument);
  EXPECT_THROW(keep(cameras, camera("", 1)), std::invalid_argument);
  EXPECT_THROW(keep(cameras, camera(std::string(61, 'x'), 1)), std::invalid_argument);
  for (std::size_t i = 1; i < max_cameras; ++i) keep(cameras, camera(std::to_string(i), 1));
  EXPECT_THROW(keep(cameras, camera("one more", 1)), std::invalid_argument);
}

TEST_F(CameraBookmarks, WhatIsNoneSaysSo) {
  for (const char* text : {"", "{", "[]", "{\"cameras\": 3}", "{\"cameras\": [{\"name\": \"a\"}]}"}) {
    write(text);
    EXPECT_THAT(error(), HasSubstr("cameras.json: is no list of cameras")) << text;
  }
  write(R"({"cameras": [{"name": "a", "position_m": [0, 0, 1e300], "orientation_xyzw": [0, 0, 0, 1]}]})");
  EXPECT_THAT(error(), HasSubstr("a camera is nowhere"));
  write(R"({"cameras": [{"name": "a", "position_m": [0, 0, 1], "orientation_xyzw": [0, 0, 0, 0]}]})");
  EXPECT_THAT(error(), HasSubstr("a camera is nowhere"));
  write(std::string((1 << 20) + 1, ' '));
  EXPECT_THAT(error(), HasSubstr("too large"));
}

}  // namespace
}  // namespace nextview
