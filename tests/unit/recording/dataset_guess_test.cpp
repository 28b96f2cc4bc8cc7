// What a folder of recorded data is taken for by the names of its files, and what is said of that.
#include "core/recording/dataset_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string matrix_of_pose = made_recording::matrix(Pose::Identity());
const std::string matrix_of_intrinsics = "500 0 320\n0 501 240\n0 0 1\n";

using Files = std::vector<std::pair<std::string, std::string>>;

/// A folder with these files, and with folders depth and poses.
struct MadeFolder : TemporaryFolder {
  explicit MadeFolder(const Files& files) {
    for (const char* part : {"depth", "poses"}) std::filesystem::create_directories(*this / part);
    for (const auto& [name, content] : files) write(name, content);
  }
};

TEST(DatasetGuess, IntrinsicsAreThoseOfTheFileThatIsNamed) {
  for (const char* name :
       {"camera-intrinsics.txt", "intrinsics.txt", "intrinsic_depth.txt", "intrinsic.txt", "camera.txt"}) {
    const MadeFolder folder(
        Files{{"frame-0.depth.png", "x"}, {"frame-0.pose.txt", matrix_of_pose}, {name, matrix_of_intrinsics}});
    const auto guess = guess_dataset(folder.path());
    ASSERT_TRUE(guess) << name;
    EXPECT_EQ(guess->description.intrinsics, "500 501 320 240");
    EXPECT_THAT(guess->guessed, Contains(std::string("intrinsics are those of ") + name));
  }
}

TEST(DatasetGuess, WithoutAFileOfIntrinsicsTheyAreUsualOnesAndThatIsSaid) {
  const MadeFolder folder(Files{{"frame-0.depth.png", "x"}, {"frame-0.pose.txt", matrix_of_pose}});
  const auto guess = guess_dataset(folder.path());
  ASSERT_TRUE(guess);
  EXPECT_EQ(guess->description.intrinsics, "525 525 319.5 239.5");
  EXPECT_THAT(guess->guessed, Contains(HasSubstr("intrinsics are not told: 525 px")));
  EXPECT_THAT(guess->guessed, Contains(HasSubstr("depths in mm along z, poses from camera to world")));
  EXPECT_EQ(guess->description.frames, "frame-*.depth.png");
  EXPECT_EQ(guess->description.poses, "frame-*.pose.txt");
}

TEST(DatasetGuess, UsualIntrinsicsAreThoseOfAsManyPixels) {
  const std::string image = made_recording::npy(120, 160, "<f4", made_recording::raw(std::vector<float>(120 * 160)));
  const MadeFolder folder(Files{{"0.depth.npy", image}, {"0.pose.txt", matrix_of_pose}});
  const auto guess = guess_dataset(folder.path());
  ASSERT_TRUE(guess);
  EXPECT_EQ(guess->description.intrinsics, "131.25 131.25 79.5 59.5");
  EXPECT_THAT(guess->guessed, Contains(HasSubstr("131.2 px and the centre of 160 x 120")));
}

TEST(DatasetGuess, RealNumbersAreMetres) {
  for (const auto& [type, data, scale] :
       {std::tuple{"<f4", made_recording::raw<float>({1.5f, 2.5f}), 1.0},
        {"<u2", made_recording::raw<std::uint16_t>({1500, 2500}), DatasetDescription().depth.scale}}) {
    const MadeFolder folder(
        Files{{"0.depth.npy", made_recording::npy(1, 2, type, data)}, {"0.pose.txt", matrix_of_pose}});
    const auto guess = guess_dataset(folder.path());
    ASSERT_TRUE(guess) << type;
    EXPECT_EQ(guess->description.depth.scale, scale) << type;
    EXPECT_THAT(guess->guessed, Contains(HasSubstr(scale == 1.0 ? "depths in m (" : "depths in mm along z")));
  }
  EXPECT_EQ(DatasetDescription().depth.scale, 0.001);
}

TEST(DatasetGuess, ATumRecordingIsKnownByItsFolderAndItsPoses) {
  for (const char* poses : {"groundtruth.txt", "poses.txt", "trajectory.txt"}) {
    const MadeFolder folder(Files{{"depth/1.5.png", "x"}, {poses, "1.5 0 0 0 0 0 0 1\n"}});
    const auto guess = guess_dataset(folder.path());
    ASSERT_TRUE(guess) << poses;
    EXPECT_EQ(guess->description.poses_format, PoseFormat::tum);
    EXPECT_DOUBLE_EQ(guess->description.depth.scale, 0.0002);
    EXPECT_THAT(guess->guessed, Contains(HasSubstr(std::string("depth/ and ") + poses)));
  }
}

TEST(DatasetGuess, CloudsHavePosesOfTheFormThatTheirFirstLineHas) {
  const auto of = [](const std::string& poses) {
    const MadeFolder folder(Files{{"0.ply", "x"}, {"poses.txt", poses}});
    const auto guess = guess_dataset(folder.path());
    EXPECT_TRUE(guess && guess->description.format == RecordingFormat::clouds);
    return guess ? guess->description.poses_format : PoseFormat::conf;
  };
  EXPECT_EQ(of("# x y z\n0 0 0 0 0 0 1\n"), PoseFormat::quaternion_xyzw);
  EXPECT_EQ(of("1.5 0 0 0 0 0 0 1\n"), PoseFormat::tum);
  EXPECT_EQ(of(matrix_of_pose), PoseFormat::matrix4x4);
}

TEST(DatasetGuess, CloudsWithoutPosesAreKnownWhereTheyPlaceThemselves) {
  const MadeFolder folder(Files{{"0.pcd", "x"}});
  const auto guess = guess_dataset(folder.path());
  ASSERT_TRUE(guess);
  EXPECT_EQ(guess->description.poses, "");
  EXPECT_THAT(guess->guessed, Contains(HasSubstr("VIEWPOINT")));
}

TEST(DatasetGuess, OthersCloudsWithoutPosesAreNoRecording) {
  const MadeFolder folder(Files{{"0.ply", "x"}});
  EXPECT_FALSE(guess_dataset(folder.path()));
}

TEST(DatasetGuess, OneScanGraphIsOne) {
  const MadeFolder one(Files{{"room.graph", "x"}});
  const auto guess = guess_dataset(one.path());
  ASSERT_TRUE(guess);
  EXPECT_EQ(guess->description.format, RecordingFormat::scan_graph);
  EXPECT_EQ(guess->description.frames, "room.graph");
  one.write("other.graph", "x");
  EXPECT_FALSE(guess_dataset(one.path())) << "which of them?";
}

}  // namespace
}  // namespace nextview
