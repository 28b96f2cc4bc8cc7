#pragma once
#include "core/cloud/point_cloud.hpp"
#include "core/recording/recording.hpp"
#include "tests/unit/recording/made_recording.hpp"

/// Recordings of a wall.
namespace nextview::made_walls {

using namespace made_recording;

/// Three places to look at a wall 2 m ahead from; 4 x 3 pixels.
inline const std::vector<Pose> poses = {
    make_pose({0, 0, 0}, Eigen::Quaterniond::Identity()), make_pose({0.5, 0, -1}, Eigen::Quaterniond::Identity()),
    make_pose({0, 1, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3::UnitY())))};

inline std::string frame(std::uint16_t value) { return depth_png(4, 3, std::vector<std::uint16_t>(12, value)); }

/// The frame's points in the world, as the definition of a pinhole puts them.
inline std::vector<Vector3> wall(const Pose& pose, double z) {
  std::vector<Vector3> points;
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 4; ++u) points.push_back(pose * Vector3((u - 1.5) / 10.0 * z, (v - 1.0) / 10.0 * z, z));
  return points;
}

inline std::vector<Vector3> world_points(const RecordedFrame& recorded) {
  const Measured measured = recorded.read();
  std::vector<Vector3> points;
  if (const auto* image = std::get_if<DepthImage>(&measured)) {
    const Scan scan = back_project(*image, recorded.T_world_camera, 100.0);
    for (const auto& hit : scan.hits) points.push_back(hit.cast<double>());
  } else {
    for (const Vector3& p : std::get<std::vector<Vector3>>(measured)) points.push_back(recorded.T_world_camera * p);
  }
  return points;
}

inline void expect_walls(const Recording& recording, const std::vector<std::size_t>& order = {0, 1, 2},
                         double z = 2.0) {
  ASSERT_EQ(recording.frames.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto found = world_points(recording.frames[i]), expected = wall(poses[order[i]], z);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_LT((found[k] - expected[k]).norm(), 1e-5) << i;
  }
}

inline constexpr const char* intrinsics = "10 0 1.5\n0 10 1\n0 0 1\n";

inline void write_3dmatch(const TemporaryFolder& folder) {
  folder.write("camera-intrinsics.txt", intrinsics);
  for (int i = 0; i < 3; ++i) {
    folder.write(fmt::format("frame-{:06}.depth.png", 9 + i), frame(2000));
    folder.write(fmt::format("frame-{:06}.color.png", 9 + i), "");
    folder.write(fmt::format("frame-{:06}.pose.txt", 9 + i), matrix(poses[static_cast<std::size_t>(i)]));
  }
}

/// What a camera 2 m before it sees.
inline PointCloud in_camera(double scale) {
  PointCloud cloud;
  for (const Vector3& p : wall(Pose::Identity(), 2.0)) cloud.push_back((scale * p).cast<float>());
  return cloud;
}

}  // namespace nextview::made_walls
