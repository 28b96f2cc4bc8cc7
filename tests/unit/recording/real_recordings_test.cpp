#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/recording/recording.hpp"
#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

const fs::path scans = fs::path(NEXTVIEW_SHARED_DIR) / "data/scans";

std::vector<DepthImage> depth_images(const Recording& recording) {
  std::vector<DepthImage> all;
  for (const RecordedFrame& frame : recording.frames) all.push_back(std::get<DepthImage>(frame.read()));
  return all;
}

/// How far the points of one frame lie from what another saw along the same rays: the median [m].
double disagreement(const DepthImage& a, const Pose& pose_a, const DepthImage& b, const Pose& pose_b) {
  std::vector<double> differences;
  for (int v = 0; v < a.camera.height; v += 5)
    for (int u = 0; u < a.camera.width; u += 5) {
      const float range = a.range[static_cast<std::size_t>(v * a.camera.width + u)];
      if (!DepthImage::is_range(range)) continue;
      const Vector3 p = pose_b.inverse() * (pose_a * (range * a.camera.direction(u, v)));
      const Eigen::Vector2d pixel = b.camera.project(p).array().round();
      if (p.z() <= 0.0 || pixel.minCoeff() < 0.0 || pixel.x() >= b.camera.width || pixel.y() >= b.camera.height)
        continue;
      const float other = b.range[static_cast<std::size_t>(pixel.y() * b.camera.width + pixel.x())];
      if (DepthImage::is_range(other)) differences.push_back(std::abs(p.norm() - other));
    }
  if (differences.size() < 1000) return 1.0;
  std::ranges::nth_element(differences, differences.begin() + std::ptrdiff_t(differences.size() / 2));
  return differences[differences.size() / 2];
}

TEST(RealRecordings, TheFramesOfTheCastleAgree) {
  if (!fs::exists(scans / "visp_castle_sim")) GTEST_SKIP() << "an addition: " << scans << " is not there";
  const Recording recording = open_recording(scans / "visp_castle_sim");
  ASSERT_EQ(recording.frames.size(), 20u);
  EXPECT_EQ(recording.frames[1].name, "Depth_0003");
  EXPECT_EQ(recording.points, 1401125u) << "values that are not 0, counted by another program";
  const std::vector<DepthImage> all = depth_images(recording);
  for (std::size_t i = 0; i + 2 < all.size(); ++i)
    EXPECT_LT(
        disagreement(all[i], recording.frames[i].T_world_camera, all[i + 2], recording.frames[i + 2].T_world_camera),
        0.0005)
        << i;
}

/// The frames were rendered from the mesh beside them. Its farthest corners tell whether the camera's offset is right.
TEST(RealRecordings, TheCastleStandsWhereItsMeshStands) {
  if (!fs::exists(scans / "visp_castle_sim")) GTEST_SKIP() << "an addition: " << scans << " is not there";
  const Recording recording = open_recording(scans / "visp_castle_sim");
  EXPECT_NEAR(recording.extent.max().x(), 0.0405595, 0.0005) << "chateau.wrl";
  EXPECT_NEAR(recording.extent.max().y(), 0.178763, 0.001);
  EXPECT_THAT(recording.guessed, testing::Contains(testing::HasSubstr("0.05 m to the right")));
}

TEST(RealRecordings, TheBunnyIsAsItsOwnReaderHasIt) {
  if (!fs::exists(scans / "stanford_bunny/bun.conf")) GTEST_SKIP() << "an addition: " << scans << " is not there";
  const Recording recording = open_recording(scans / "stanford_bunny", {.every = 3, .stand_off = 0.5});
  ASSERT_EQ(recording.frames.size(), 4u);
  EXPECT_EQ(recording.frames[1].name, "bun180");
  EXPECT_EQ(recording.frames[2].name, "top3");
  EXPECT_LT(recording.extent.sizes().maxCoeff(), 0.25);
  EXPECT_GT(recording.max_range, 0.5);
  EXPECT_LE(recording.camera.width, 640);
  EXPECT_THAT(recording.guessed, testing::Contains(testing::HasSubstr("0.5 m")));
  for (const fs::path& file : recording.files) EXPECT_TRUE(fs::exists(file)) << file;
}

}  // namespace
}  // namespace nextview
