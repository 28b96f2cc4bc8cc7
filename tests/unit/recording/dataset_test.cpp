#include "core/recording/dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/recording/dataset_guess.hpp"
#include "core/recording/frame_files.hpp"
#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

using made_recording::failure_of;
using testing::HasSubstr;

DatasetDescription everything() {
  DatasetDescription d;
  d.frames = "depth/*.raw";
  d.depth = {320, 240, RawType::float32, 16, 0.25, DepthMeasures::range, ZeroDepth::beyond, DepthEncoding::rotate3};
  d.poses = "poses/*.txt";
  d.poses_format = PoseFormat::quaternion_wxyz;
  d.pose_direction = PoseDirection::world_to_sensor;
  d.pose_axes = PoseAxes::body;
  d.camera_offset = "0.1 0.2 0.3 0 0 0 1";
  d.intrinsics = "500 501.5 160 120";
  d.mask = "mask.png";
  d.region = "-1 -1 0 1 1 2.5";
  return d;
}

TEST(Dataset, WhatIsWrittenIsReadBack) {
  const TemporaryFolder folder;
  const DatasetDescription d = everything();
  DatasetDescription read = read_dataset(folder.write("dataset.toml", to_toml(d)));
  DatasetDescription copy = d;
  const auto expected = settings(copy), found = settings(read);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].text(), expected[i].text()) << found[i].key;
  EXPECT_EQ(read.camera().fy, 501.5);
  EXPECT_EQ(read.region_box()->max(), Vector3(1, 1, 2.5));
  EXPECT_EQ(read.offset().translation(), Vector3(0.1, 0.2, 0.3));

  DatasetDescription clouds;
  clouds.format = RecordingFormat::clouds, clouds.frames = "*.ply", clouds.unit = CloudUnit::mm;
  const DatasetDescription again = read_dataset(folder.write("dataset.toml", to_toml(clouds)));
  EXPECT_EQ(again.format, RecordingFormat::clouds);
  EXPECT_EQ(again.unit, CloudUnit::mm);
  EXPECT_THAT(to_toml(clouds), Not(HasSubstr("depth")));
}

TEST(Dataset, MistakesAreNamedByLine) {
  const TemporaryFolder folder;
  const auto why = [&](const std::string& text) {
    const auto file = folder.write("dataset.toml", text);
    return failure_of([&] { read_dataset(file); });
  };
  EXPECT_THAT(why("format = \"clouds\"\nframe = \"*.ply\"\n"),
              HasSubstr("dataset.toml:2: there is no key 'frame'; did you mean 'frames'?"));
  EXPECT_THAT(why("[depth]\nscal = 1\n"), HasSubstr(":2: there is no key 'depth.scal'; did you mean 'depth.scale'?"));
  EXPECT_THAT(why("format = \"cloud\"\n"), HasSubstr(":1: format takes one of depth-images"));
  EXPECT_THAT(why("width = 20000\n"), HasSubstr(":1: width must be"));
  EXPECT_THAT(why("depth.scale = 0\n"), HasSubstr(":1: depth.scale must be"));
  EXPECT_THAT(why("depth.scale = nan\n"), HasSubstr(":1: depth.scale must be"));
  EXPECT_THAT(why("width = \"3\"\n"), HasSubstr(":1: width takes a number without quotes"));
  EXPECT_THAT(why("frames = [\"a\"]\n"), HasSubstr(":1: frames takes a text"));
  EXPECT_THAT(why("frames = \n"), HasSubstr("dataset.toml:1: "));
  EXPECT_THAT(why(""), HasSubstr("the key frames is missing"));
  EXPECT_THAT(why("frames = \"*.png\"\nposes = \"p.txt\"\n"), HasSubstr("the key intrinsics is missing"));
  EXPECT_THAT(why("frames = \"*.png\"\nposes = \"p.txt\"\nintrinsics = [1, 2, 3]\n"), HasSubstr("four numbers"));
  EXPECT_THAT(why("format = \"clouds\"\nframes = \"*.ply\"\nregion = [0, 0, 0, 1, 1, 0]\n"), HasSubstr("region takes"));
}

TEST(Dataset, DamageIsSurvived) {
  const TemporaryFolder folder;
  made_recording::survives_damage(folder, "dataset.toml", to_toml(everything()),
                                  [](const auto& file) { read_dataset(file); });
}

TEST(Dataset, PatternsFindFilesInNaturalOrderAndStayInTheFolder) {
  const TemporaryFolder folder;
  for (const char* name :
       {"frame-10.png", "frame-2.png", "frame-2.color.png", "other.png", "frame-1.png.gz", "frame-2.png.gz"})
    folder.write(name, "");
  const auto found = find_frame_files(folder / "", "frame-*.png");
  std::vector<std::string> names;
  for (const FrameFile& file : found) names.push_back(file.file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"frame-1.png.gz", "frame-2.color.png", "frame-2.png", "frame-10.png"}));
  EXPECT_EQ(found[3].name, "frame-10");
  EXPECT_EQ(found[3].key, "10");
  EXPECT_TRUE(find_frame_files(folder / "", "*.bin").empty());
  for (const char* outside : {"../*.png", "/etc/*", "a/../../b", "*/x.png", "*a*a*a*a*a"})
    EXPECT_NE(failure_of([&] { find_frame_files(folder / "", outside); }), "") << outside;
}

TEST(Dataset, ViSPsCastleIsKnownInOneFolderAndAsDebianHasIt) {
  using namespace std::string_literals;
  const std::string image = "\1\0\0\0\2\0\0\0"s + "\0\0\0\0"s;  // 1 x 2 pixels
  for (const auto& [depths, poses] : {std::pair{"", ""}, {"Depth/", "CameraPose/"}}) {
    const TemporaryFolder folder;
    for (const char* part : {"Depth", "CameraPose"}) std::filesystem::create_directories(folder / part);
    folder.write(std::string(depths) + "Depth_0001.bin", image);
    folder.write(std::string(poses) + "Camera_001.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    const auto guess = guess_dataset(folder / "");
    ASSERT_TRUE(guess);
    EXPECT_EQ(guess->description.frames, std::string(depths) + "Depth_*.bin");
    EXPECT_EQ(guess->description.poses, std::string(poses) + "Camera_*.txt");
    EXPECT_EQ(guess->description.depth.width, 2);
  }
}

TEST(Dataset, UnknownFoldersSayWhatWasLookedFor) {
  const TemporaryFolder folder;
  EXPECT_THAT(failure_of([&] { describe_dataset(folder / ""); }), HasSubstr("is an empty folder"));
  folder.write("notes.txt", "");
  EXPECT_THAT(failure_of([&] { describe_dataset(folder / ""); }),
              testing::AllOf(HasSubstr("groundtruth.txt"), HasSubstr("--write-dataset")));
  folder.write("manifest.json", "{}");
  EXPECT_THAT(failure_of([&] { describe_dataset(folder / ""); }), HasSubstr("results of Nextview"));
  EXPECT_THAT(failure_of([&] { describe_dataset(folder / "no"); }), HasSubstr("no such file or folder"));
  EXPECT_THAT(failure_of([&] { describe_dataset(folder.write("a.xyz", "")); }), HasSubstr("is no recording"));
}

}  // namespace
}  // namespace nextview
