#include "core/recording/recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "tests/unit/recording/made_walls.hpp"

namespace nextview {
namespace {

using namespace made_walls;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Recording, ThreeDMatch) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  const Recording recording = open_recording(folder / "");
  expect_walls(recording);
  EXPECT_EQ(recording.format, "depth-images");
  EXPECT_EQ(recording.frames[1].name, "frame-000010");
  EXPECT_EQ(recording.points, 36u);
  EXPECT_EQ(recording.camera.width, 4);
  EXPECT_NEAR(recording.max_range, 1.01 * wall(poses[0], 2.0)[0].norm(), 1e-5);
  Eigen::AlignedBox3d box;
  for (const Pose& pose : poses)
    for (const Vector3& p : wall(pose, 2.0)) box.extend(p);
  EXPECT_TRUE(recording.extent.isApprox(box, 1e-5));
  EXPECT_EQ(recording.files.size(), 6u);
  EXPECT_FALSE(recording.guessed.empty());
}

TEST(Recording, EveryNthFrameProgressAndStop) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  std::vector<double> fractions;
  expect_walls(open_recording(folder / "", {.every = 2}, [&](double f, std::string_view) { fractions.push_back(f); }),
               {0, 2});
  EXPECT_THAT(fractions, ElementsAre(0.0, 0.5, 1.0));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(open_recording(folder / "", {}, {}, stop.get_token()), Stopped);
  EXPECT_THROW(open_recording(folder / "", {.every = 0}), std::invalid_argument);
}

// They are read by several threads.
TEST(Recording, OfSeveralDamagedFramesTheFirstIsNamed) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  for (const char* name : {"frame-000011.depth.png", "frame-000010.depth.png"}) folder.write(name, "no image");
  try {
    open_recording(folder / "");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame-000010"));
  }
}

TEST(Recording, Princeton) {
  const TemporaryFolder folder;
  std::string info = std::string("# Bin: B\n# Color camera intrinsic matrix\n") + intrinsics +
                     "# Depth camera intrinsic matrix\n9 0 1\n0 9 1\n0 0 1\n# Depth-to-color\n" + matrix(poses[1]);
  for (int i = 2; i >= 0; --i)  // headings count, not the order
    info += fmt::format("# Camera-to-world for frame-00000{}\n{}\n", i, matrix(poses[static_cast<std::size_t>(i)]));
  folder.write("cam.info.txt", info);
  for (int i = 0; i < 3; ++i)  // 20000 x 0.1 mm
    folder.write(fmt::format("frame-00000{}.depth.png", i),
                 frame(static_cast<std::uint16_t>(20000 << 3 | 20000 >> 13)));
  expect_walls(open_recording(folder / ""));
}

TEST(Recording, TumTakesTheNearestPoseInTimeAndLeavesOutFramesWithout) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "depth");
  std::string truth = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Quaterniond q(poses[i].linear());
    const Vector3 t = poses[i].translation();
    truth += fmt::format("{:.4f} {} {} {} {:.17g} {:.17g} {:.17g} {:.17g}\n", 1305031100.01 + 0.1 * double(i), t.x(),
                         t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    folder.write(fmt::format("depth/{:.6f}.png", 1305031100.0 + 0.1 * double(i)), frame(10000));
  }
  folder.write("depth/1305031109.000000.png", frame(10000));
  folder.write("groundtruth.txt", truth);
  folder.write("intrinsics.txt", intrinsics);
  const Recording recording = open_recording(folder / "");
  expect_walls(recording);
  EXPECT_THAT(recording.guessed, testing::Contains(HasSubstr("1305031109.000000")));
}

TEST(Recording, RawImagesByDescriptionWithMaskOffsetAndRegion) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "poses");
  Pose T_posed_camera = make_pose({0.05, 0, 0}, Eigen::Quaterniond::Identity());
  for (std::size_t i = 0; i < 3; ++i) {
    folder.write(fmt::format("Depth_{}.bin", i), "head" + raw(std::vector<float>(12, 4.0f)));
    folder.write(fmt::format("poses/cam{:03}.txt", i), matrix((poses[i] * T_posed_camera.inverse()).inverse()));
  }
  folder.write("mask.png", png(4, 3, 8, 0, std::string(15, '\0')));
  const auto toml = folder.write("dataset.toml",
                                 "frames = \"Depth_*.bin\"\nwidth = 4\nheight = 3\ntype = \"float32\"\noffset = 4\n"
                                 "poses = \"poses/cam*.txt\"\npose_direction = \"world-to-sensor\"\n"
                                 "intrinsics = [10, 10, 1.5, 1]\nmask = \"mask.png\"\nregion = [0, 0, 0, 1, 2, 3]\n"
                                 "camera_offset = [0.05, 0, 0]\n[depth]\nscale = 0.5\n");
  const Recording recording = open_recording(folder / "");
  expect_walls(recording);
  expect_walls(open_recording(toml));
  ASSERT_TRUE(recording.region);
  EXPECT_EQ(recording.region->max(), Vector3(1, 2, 3));
  EXPECT_TRUE(recording.guessed.empty());
  EXPECT_EQ(recording.files.size(), 8u);
}

/// Clouds and poses in units of a metre over `scale`.
void write_clouds(const TemporaryFolder& folder, double scale) {
  for (std::size_t i = 0; i < 3; ++i) {
    write_ply(in_camera(scale), folder / fmt::format("scan{}.ply", i));
    Pose pose = poses[i];
    pose.translation() *= scale;
    folder.write(fmt::format("scan{}.txt", i), matrix(pose));
  }
}

TEST(Recording, CloudsWithPosesInMillimetres) {
  const TemporaryFolder folder;
  write_clouds(folder, 1000.0);
  const Recording recording = open_recording(folder / "");
  expect_walls(recording);
  EXPECT_THAT(recording.guessed, testing::Contains(HasSubstr("taken as mm")));
  EXPECT_NEAR(recording.max_range, 1.01 * wall(poses[0], 2.0)[0].norm(), 1e-5);
  // The camera holds every ray, through pixel centres, with about as many pixels as points.
  const PinholeCamera& camera = recording.camera;
  for (const Vector3& p : wall(Pose::Identity(), 2.0)) {
    const Eigen::Vector2d pixel = camera.project(p);
    EXPECT_GE(pixel.minCoeff(), -1e-4);
    EXPECT_LE(pixel.x(), camera.width - 1 + 1e-4);
    EXPECT_LE(pixel.y(), camera.height - 1 + 1e-4);
  }
  EXPECT_NEAR(camera.width * camera.height, 12, 10);
}

TEST(Recording, TheUnitOfCloudsIsGuessedAsThatOfObjectsAndSaid) {
  const TemporaryFolder folder;
  write_clouds(folder, 30.0);
  const Recording small = open_recording(folder / "");
  EXPECT_LT(small.extent.sizes().maxCoeff(), 0.2) << "no part of 70 m";
  EXPECT_THAT(small.guessed, testing::Contains(HasSubstr("taken as mm")));
  write_clouds(folder, 1.0);
  const Recording large = open_recording(folder / "");
  expect_walls(large);
  EXPECT_THAT(large.guessed, testing::Contains(HasSubstr("taken as m,")));
}

TEST(Recording, PcdsWithTheirOwnViewpoint) {
  const TemporaryFolder folder;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Quaterniond q(poses[i].linear());
    const Vector3 t = poses[i].translation();
    const PointCloud points = in_camera(1.0);
    std::string data;
    for (const Eigen::Vector3f& p : points)
      data += i == 0 ? fmt::format("7 {} {} {}\n", p.x(), p.y(), p.z())
                     : std::string(1, 'i') + std::string(reinterpret_cast<const char*>(p.data()), 12);
    data += i == 0 ? "7 nan nan nan\n" : std::string("i\0\0\xc0\x7f\0\0\xc0\x7f\0\0\xc0\x7f", 13);
    folder.write(
        fmt::format("{}.pcd", i),
        fmt::format("# .PCD v0.7\nVERSION 0.7\nFIELDS i x y z\nSIZE 1 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\nWIDTH 13\n"
                    "HEIGHT 1\nVIEWPOINT {} {} {} {:.17g} {:.17g} {:.17g} {:.17g}\nPOINTS 13\nDATA {}\n{}",
                    t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z(), i == 0 ? "ascii" : "binary", data));
  }
  const Recording recording = open_recording(folder / "");
  expect_walls(recording);
  EXPECT_THAT(recording.guessed, testing::Contains("clouds of 36 points (3 that are not finite left out)"));
}

TEST(Recording, RaysBehindTheCameraAreSaid) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.log", "NODE 0 0 0 0 0 0\n1 0 0\n1 0.5 0.2\n-1 0 0\n1 9 0\nNODE 5 0 0 0 0 0\n");
  const Recording recording = open_recording(file);
  EXPECT_EQ(recording.format, "scan-graph");
  EXPECT_EQ(recording.points, 4u);
  EXPECT_THAT(recording.guessed,
              ElementsAre(HasSubstr("50.0 % of the rays"), HasSubstr("1 frame measured nothing, scan 2")));
  EXPECT_EQ(world_points(recording.frames[0])[1], Vector3(1, 0.5, 0.2));
}

TEST(Recording, SceneFile) {
  const TemporaryFolder folder;
  std::string text =
      "param bbox_min_x_m -1\nparam bbox_min_y_m -2\nparam bbox_min_z_m -3\nparam bbox_max_x_m 1\n"
      "param bbox_max_y_m 2\nparam bbox_max_z_m 3\n";
  for (const Pose& pose : poses) {
    const Eigen::Quaterniond q(pose.linear());
    const Vector3 t = pose.translation();
    text += fmt::format("scan {} {} {} {:.17g} {:.17g} {:.17g} {:.17g} 12\n", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                        q.w());
    for (const Vector3& p : wall(Pose::Identity(), 2.0)) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  }
  const Recording recording = open_recording(folder.write("scene.txt", text));
  expect_walls(recording);
  ASSERT_TRUE(recording.region);
  EXPECT_EQ(recording.region->min(), Vector3(-1, -2, -3));
}

TEST(Recording, WhatCannotBeRightIsOneLineThatNamesTheFile) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  const auto why = [&] { return failure_of([&] { open_recording(folder / ""); }); };
  folder.write("frame-000010.depth.png", frame(2000).substr(0, 50));
  EXPECT_THAT(why(), HasSubstr("frame-000010.depth.png: is truncated"));
  folder.write("frame-000010.depth.png", depth_png(2, 2, {1, 2, 3, 4}));
  EXPECT_THAT(why(), HasSubstr("frame-000010: the image has 2 x 2 pixels, those before it 4 x 3"));
  folder.write("frame-000010.depth.png", frame(0));
  EXPECT_THAT(open_recording(folder / "").guessed,
              testing::Contains(HasSubstr("1 frame measured nothing, frame-000010")));
  folder.write("frame-000010.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n");
  EXPECT_THAT(why(), HasSubstr("frame-000010.pose.txt:1: the pose's rotation is none"));
  std::filesystem::remove(folder / "frame-000010.pose.txt");
  EXPECT_THAT(open_recording(folder / "").guessed, testing::Contains(HasSubstr("1 frame without a pose is left out")));
  for (int i = 9; i < 12; ++i) folder.write(fmt::format("frame-{:06}.depth.png", i), frame(0));
  EXPECT_THAT(why(), HasSubstr("measured nothing"));
}

}  // namespace
}  // namespace nextview
