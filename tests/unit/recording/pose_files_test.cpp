#include "core/recording/pose_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

using made_recording::failure_of;
using testing::HasSubstr;

const Eigen::Quaterniond turn = Eigen::Quaterniond(0.5, -0.3, 0.7, 0.2).normalized();
const Pose pose = make_pose({1.0, -2.0, 3.5}, turn);

std::string rows(const Pose& p, int count, const char* between = "\n") {
  std::string text;
  for (int r = 0; r < count; ++r)
    for (int c = 0; c < 4; ++c) text += fmt::format("{:.17g}{}", p.matrix()(r, c), c == 3 ? between : " ");
  return text;
}

void expect_pose(const Pose& found, const Pose& expected) {
  EXPECT_LT((found.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-12) << found.matrix();
}

TEST(PoseFiles, MatricesOfEachForm) {
  const TemporaryFolder folder;
  for (const std::string& text : {rows(pose, 4), rows(pose, 3), rows(pose, 4, " "), rows(pose, 3, " "),
                                  "bun.ply " + rows(pose, 4, " "), "# heading\n\n" + rows(pose, 4)}) {
    const auto poses = read_poses(folder.write("p.txt", text), PoseFormat::matrix4x4);
    ASSERT_EQ(poses.size(), 1u) << text;
    expect_pose(poses[0].T_world_camera, pose);
  }
  EXPECT_EQ(read_poses(folder.write("p.txt", rows(pose, 4) + rows(pose, 4)), PoseFormat::matrix4x4).size(), 2u);
  EXPECT_EQ(read_poses(folder.write("p.txt", rows(pose, 3) + rows(pose, 3)), PoseFormat::matrix4x4).size(), 2u);
}

TEST(PoseFiles, HeadingsNameMatricesAndOthersArePassedOver) {
  const TemporaryFolder folder;
  const std::string text = "# Bin: A\n\n# Color intrinsics\n600 0 300\n0 610 200\n0 0 1\n\n# pose for frame-000000\n" +
                           rows(pose, 4) + "\n# pose for frame-000001\n" + rows(pose.inverse(), 4);
  const auto file = folder.write("cam.info.txt", text);
  const auto poses = read_poses(file, PoseFormat::matrix4x4);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_THAT(poses[1].heading, HasSubstr("frame-000001"));
  expect_pose(poses[1].T_world_camera, pose.inverse());
  const PinholeCamera camera = read_intrinsics(file, "Color");
  EXPECT_EQ(Eigen::Vector4d(camera.fx, camera.fy, camera.cx, camera.cy), Eigen::Vector4d(600, 610, 300, 200));
}

TEST(PoseFiles, QuaternionsOfEachOrder) {
  const TemporaryFolder folder;
  const std::string xyz = "1 -2 3.5 ", xyz_q = fmt::format("{:.17g} {:.17g} {:.17g}", turn.x(), turn.y(), turn.z());
  const std::string w = fmt::format("{:.17g}", turn.w());
  const auto one = [&](const std::string& text, PoseFormat format) {
    const auto poses = read_poses(folder.write("p.txt", "# x y z\n" + text + "\n"), format);
    EXPECT_EQ(poses.size(), 1u);
    return poses.front();
  };
  expect_pose(one(xyz + xyz_q + " " + w, PoseFormat::quaternion_xyzw).T_world_camera, pose);
  expect_pose(one("name.ply " + xyz + w + " " + xyz_q, PoseFormat::quaternion_wxyz).T_world_camera, pose);
  const NamedPose timed = one("1305.25 " + xyz + xyz_q + " " + w, PoseFormat::tum);
  expect_pose(timed.T_world_camera, pose);
  EXPECT_EQ(timed.time, 1305.25);
  const NamedPose mesh = one("camera 1 2\nbmesh a.ply " + xyz + xyz_q + " " + w, PoseFormat::conf);
  expect_pose(mesh.T_world_camera, make_pose({1.0, -2.0, 3.5}, turn.conjugate()));
  EXPECT_EQ(mesh.heading, "a.ply");
}

TEST(PoseFiles, QuaternionsMayHaveTheirFramesWholeNumbersInFront) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text, PoseFormat format = PoseFormat::quaternion_xyzw) {
    return read_poses(folder.write("p.txt", text + " 1 -2 3.5 0 0 0 1\n"), format).at(0);
  };
  for (const auto& [number, name] : {std::pair{"12", "12"}, {"0", "0"}, {"7.0", "7"}, {"000012", "12"}}) {
    EXPECT_EQ(read(number).heading, name);
    expect_pose(read(number).T_world_camera, make_pose({1.0, -2.0, 3.5}, Eigen::Quaterniond::Identity()));
  }
  for (const char* none : {"-1", "1.5", "frame 3", "1 2"})
    EXPECT_THAT(failure_of([&] { read(none); }), HasSubstr("p.txt:1: expected 7 numbers, found")) << none;
  EXPECT_THAT(failure_of([&] { read("bmesh a.ply 3", PoseFormat::conf); }), HasSubstr("expected 7 numbers, found 8"));
}

TEST(PoseFiles, DirectionsAndAxes) {
  const TemporaryFolder folder;
  const auto file = folder.write("p.txt", rows(pose, 4));
  expect_pose(read_poses(file, PoseFormat::matrix4x4, PoseDirection::world_to_sensor)[0].T_world_camera,
              pose.inverse());
  const Pose body =
      read_poses(file, PoseFormat::matrix4x4, PoseDirection::sensor_to_world, PoseAxes::body)[0].T_world_camera;
  // Forward is x of the body and z of the camera; up is z of the body and -y of the camera.
  EXPECT_LT((body.linear() * Vector3::UnitZ() - pose.linear() * Vector3::UnitX()).norm(), 1e-12);
  EXPECT_LT((body.linear() * -Vector3::UnitY() - pose.linear() * Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_TRUE(is_pose(body));
}

TEST(PoseFiles, NearlyRigidIsMadeRigidAndTheRestRefusedByLine) {
  const TemporaryFolder folder;
  Pose p = pose;
  p.linear() *= 1.0003;
  EXPECT_TRUE(is_pose(read_poses(folder.write("p.txt", rows(p, 4)), PoseFormat::matrix4x4)[0].T_world_camera));
  p.linear() *= 1.01;
  const auto why = [&](const std::string& text, PoseFormat format = PoseFormat::matrix4x4) {
    return failure_of([&] { read_poses(folder.write("p.txt", text), format).at(0).pose(); });
  };
  EXPECT_THAT(why("# a\n" + rows(p, 4)), HasSubstr("p.txt:2: the pose's rotation is none"));
  p = pose;
  p.linear().col(0) *= -1.0;
  EXPECT_THAT(why(rows(p, 4)), HasSubstr("p.txt:1: the pose mirrors"));
  EXPECT_FALSE(
      read_poses(folder.write("p.txt", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), PoseFormat::matrix4x4).at(0).pose());
  EXPECT_THAT(why("1 0 0 0\n0 1 0 0\n"), HasSubstr("expected 3 or 4 rows"));
  EXPECT_THAT(why("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 1 0 1\n"), HasSubstr("expected 3 or 4 rows"));
  EXPECT_THAT(why("1 0 0 2e6\n0 1 0 0\n0 0 1 0\n"), HasSubstr("p.txt:1: the pose lies over 1e+06 m off"));
  EXPECT_THAT(why("0 0 0 0 0 0 2\n", PoseFormat::quaternion_xyzw), HasSubstr("p.txt:1: the quaternion has length 2"));
  EXPECT_THAT(why("1 2 3\n", PoseFormat::tum), HasSubstr("p.txt:1: expected 8 numbers, found 3"));
  EXPECT_THAT(why("hello\n"), HasSubstr("holds no pose"));
}

TEST(PoseFiles, DamageIsSurvived) {
  const TemporaryFolder folder;
  made_recording::survives_damage(folder, "p.txt", "# heading\n" + rows(pose, 4) + rows(pose, 4),
                                  [](const auto& file) { read_poses(file, PoseFormat::matrix4x4); });
}

}  // namespace
}  // namespace nextview
