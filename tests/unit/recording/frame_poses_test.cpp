// Which pose is whose, and what the files of others say otherwise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/recording/dataset_guess.hpp"
#include "tests/unit/recording/made_walls.hpp"

namespace nextview {
namespace {

using namespace made_walls;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

/// Frames of a wall whose poses stand in one file.
class PosesInOneFile : public testing::Test {
 protected:
  PosesInOneFile() {
    for (int i = 0; i < 3; ++i) folder_.write(fmt::format("f{}.png", i + 1), frame(2000));
  }
  Recording with(const std::string& poses_file, const std::string& format = "matrix4x4") const {
    folder_.write("poses.txt", poses_file);
    folder_.write("dataset.toml", "frames = \"f*.png\"\nposes = \"poses.txt\"\nposes_format = \"" + format +
                                      "\"\nintrinsics = [10, 10, 1.5, 1]\n");
    return open_recording(folder_ / "");
  }
  static std::string line(const Pose& pose, bool by_columns) {
    std::string text;
    for (int i = 0; i < 16; ++i)
      text += fmt::format("{:.17g} ", by_columns ? pose.matrix()(i % 4, i / 4) : pose.matrix()(i / 4, i % 4));
    return text + "\n";
  }
  TemporaryFolder folder_;
};

TEST_F(PosesInOneFile, SixteenNumbersALineStandByRowsOrByColumns) {
  const auto lines = [](bool by_columns) {
    return line(poses[0], by_columns) + line(poses[1], by_columns) + line(poses[2], by_columns);
  };
  const Recording by_rows = with(lines(false)), by_columns = with(lines(true));
  expect_walls(by_rows);
  EXPECT_THAT(by_rows.guessed, Each(Not(HasSubstr("by columns"))));
  expect_walls(by_columns);
  EXPECT_THAT(by_columns.guessed, Contains(HasSubstr("by columns")));
  std::string neither = lines(false);
  neither.replace(neither.rfind("0 0 0 1 \n"), 7, "0 0 1 1");
  EXPECT_THAT(failure_of([&] { with(neither); }), HasSubstr("poses.txt:3: the last row of a pose must be 0 0 0 1"));
}

TEST_F(PosesInOneFile, HeadingsThatTellNoFramesApartMeanTheOrder) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += fmt::format("Frame {}: pose (4x4)\n", i + 1) + matrix(poses[std::size_t(i)]);
  const Recording recording = with(text);
  expect_walls(recording);
  EXPECT_THAT(recording.guessed, Contains(HasSubstr("taken in order")));
}

TEST_F(PosesInOneFile, HeadingsFromZeroOfFramesFromOneMeanTheOrder) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += fmt::format("# pose {}\n", i) + matrix(poses[std::size_t(i)]);
  expect_walls(with(text));
}

TEST_F(PosesInOneFile, IntrinsicsAboveThemAreNone) {
  const std::string intrinsics_4x4 = "10 0 1.5 0\n0 10 1 0\n0 0 1 0\n0 0 0 1\n";
  std::string named = "Intrinsics\n" + intrinsics_4x4, plain = intrinsics_4x4;
  for (int i = 0; i < 3; ++i) {
    named += fmt::format("f{}\n", i + 1) + matrix(poses[std::size_t(i)]);
    plain += "\n" + matrix(poses[std::size_t(i)]);
  }
  expect_walls(with(named));
  expect_walls(with(plain));
  EXPECT_THAT(failure_of([&] { with("f1\n" + intrinsics_4x4); }), HasSubstr("poses.txt:2: the pose's rotation is none"))
      << "whose frame takes it";
}

TEST_F(PosesInOneFile, NumbersBeforeQuaternionsAreTheFrames) {
  std::string text;
  for (const int i : {2, 0, 1}) {
    const Eigen::Quaterniond q(poses[std::size_t(i)].linear());
    const Vector3 t = poses[std::size_t(i)].translation();
    text += fmt::format("{} {} {} {} {:.17g} {:.17g} {:.17g} {:.17g}\n", i + 1, t.x(), t.y(), t.z(), q.x(), q.y(),
                        q.z(), q.w());
  }
  expect_walls(with(text, "quaternion_xyzw"));
  for (int i = 0; i < 3; ++i) write_ply(in_camera(1.0), folder_ / fmt::format("{:03}.ply", i + 1));
  std::filesystem::remove(folder_ / "dataset.toml");
  expect_walls(open_recording(folder_ / ""));  // guessed: times that are whole numbers
}

TEST(FramePoses, OnesThatAreNotKnownLeaveTheirFramesOut) {
  for (const char* unknown : {"-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n0 0 0 1\n",
                              "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\nnan nan nan nan\n"}) {
    const TemporaryFolder folder;
    write_3dmatch(folder);
    folder.write("frame-000010.pose.txt", unknown);
    const Recording recording = open_recording(folder / "");
    expect_walls(recording, {0, 2});
    EXPECT_THAT(recording.guessed, Contains(HasSubstr("1 frame without a pose is left out, frame-000010")));
  }
}

TEST(FramePoses, OnesWithoutAFrameAreTold) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  std::filesystem::remove(folder / "frame-000010.depth.png");
  const Recording recording = open_recording(folder / "");
  expect_walls(recording, {0, 2});
  EXPECT_THAT(recording.guessed, Contains("1 pose without a frame is left out, frame-000010.pose.txt for example"));
}

TEST(FramePoses, InMillimetresAreDoubted) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  EXPECT_THAT(open_recording(folder / "").guessed, Not(Contains(HasSubstr("millimetres"))));
  for (int i = 0; i < 3; ++i) {
    Pose pose = poses[std::size_t(i)];
    pose.translation() *= 1000.0;
    folder.write(fmt::format("frame-{:06}.pose.txt", 9 + i), matrix(pose));
  }
  EXPECT_THAT(open_recording(folder / "").guessed, Contains(HasSubstr("are their poses in millimetres, not metres?")));
  DatasetDescription description = guess_dataset(folder / "")->description;
  description.unit = CloudUnit::mm;
  folder.write("dataset.toml", to_toml(description));
  const Recording mended = open_recording(folder / "");
  expect_walls(mended);
  EXPECT_EQ(mended.doubt, "");
}

TEST(GuessedDataset, RealNumbersAreMetres) {
  for (const std::string type : {"<f4", "<f8", "<u2"}) {
    const TemporaryFolder folder;
    folder.write("camera-intrinsics.txt", intrinsics);
    for (int i = 0; i < 3; ++i) {
      const std::string data = type == "<f4"   ? raw(std::vector<float>(12, 2.0f))
                               : type == "<f8" ? raw(std::vector<double>(12, 2.0))
                                               : raw(std::vector<std::uint16_t>(12, 2000));
      folder.write(fmt::format("{}.depth.npy", i), npy(3, 4, type, data));
      folder.write(fmt::format("{}.pose.txt", i), matrix(poses[std::size_t(i)]));
    }
    expect_walls(open_recording(folder / ""));
  }
}

TEST(GuessedDataset, AConfThatPlacesNoScansIsNotStanfords) {
  const TemporaryFolder folder;
  write_3dmatch(folder);
  folder.write("camera.conf", "fx=10\nfy=10\n");
  expect_walls(open_recording(folder / ""));
}

TEST(Recording, StanfordsRangeImagesMayHaveAUnit) {
  const TemporaryFolder folder;
  write_ply({{0, 0, 0}, {100, 0, 0}, {0, 100, -50}}, folder / "a.ply");
  folder.write("a.conf", "bmesh a.ply 10 20 30 0 0 0 1\n");
  EXPECT_THAT(failure_of([&] { open_recording(folder / ""); }), HasSubstr("dataset.toml has a unit"));
  folder.write("dataset.toml", "format = \"stanford\"\nunit = \"mm\"\n");
  const Recording recording = open_recording(folder / "");
  EXPECT_LT((recording.extent.min() - Vector3(0.01, 0.02, -0.02)).norm(), 1e-6);
  EXPECT_LT((recording.extent.max() - Vector3(0.11, 0.12, 0.03)).norm(), 1e-6);
  EXPECT_THAT(to_toml(describe_dataset(folder / "").description), HasSubstr("unit = 'mm'"));
}

}  // namespace
}  // namespace nextview
