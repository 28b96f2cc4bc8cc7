// What is written of demos: frames, animations and videos.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "core/file/read_file.hpp"
#include "tests/integration/demos.hpp"
#include "tests/render/animation_pictures.hpp"
#include "tests/render/render_test.hpp"
#include "ui/demo/demo_video.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;
using DemoOutput = Demos;

TEST_F(DemoOutput, FramesAndTheirListAreReplacedByThoseOfTheNextRun) {
  const auto write = [&](const std::string& text) {
    OutputFolder out(folder_ / "out", {});
    out.begin("demo");
    return write_demo(demo(text), small, out, [](int) {}, {});
  };
  EXPECT_EQ(write("title \"A\" 1\nwait 1\n"), 4);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "frame_00004.png"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "config.toml"));
  EXPECT_EQ(write("title \"A\" 1\nwait 0.5\nwait 0.25\n"), 4) << "and what the title still takes";
  EXPECT_EQ(write("wait 0.5\n"), 2);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "frame_00003.png"));
  EXPECT_EQ(read_manifest(folder_ / "out")->files.size(), 3u);
}

TEST_F(DemoOutput, WhatIsWrittenIsWhatIsPlayedAndItsAnimationShowsIt) {
  const Demo played = demo("title \"A\" 1\nwait 1.25\ncaption \"b\"\nwait 1\n");
  const auto expected = frames(played, small);
  EXPECT_EQ(expected.size(), 9u) << "of 2.25 s";
  OutputFolder out(folder_ / "out", {});
  out.begin("demo");
  std::vector<int> told;
  EXPECT_EQ(write_demo(played, small, out, [&](int number) { told.push_back(number); }, {}), 9);
  EXPECT_THAT(told, ::testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  std::vector<Image> written;
  for (int number = 1; number <= 9; ++number)
    written.push_back(read_png(folder_ / "out" / fmt::format("frame_{:05}.png", number)));
  expect_same(written, expected);
  write_video(folder_ / "out", small.frames_per_second, folder_ / "a.png");
  expect_same(animation_pictures(folder_ / "a.png"), expected);
}

TEST_F(DemoOutput, AVideoNeedsItsProgramAndAnEndingThatItKnows) {
  EXPECT_THROW(require_video("a.avi"), std::invalid_argument);
  EXPECT_NO_THROW(require_video("a.png")) << "that needs no other program";
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ("/nowhere::" + (folder_ / "none").string()).c_str(), 1);
  EXPECT_THROW(require_video("a.mp4"), std::runtime_error);
  EXPECT_THROW(require_video("a.webm"), std::runtime_error);
  EXPECT_NO_THROW(require_video("a.png"));
  EXPECT_THROW(require_video("a"), std::invalid_argument) << "whatever program there is";
  ::setenv("PATH", path.c_str(), 1);
}

/// In its place stands a script that writes down how it was called, or says what is wrong.
TEST_F(DemoOutput, AVideoIsMadeByItsProgramWhichSaysWhyItCannot) {
  const fs::path program = folder_ / "ffmpeg", video = folder_ / "a.webm";
  write_file(program,
             "#!/bin/sh\nfor last; do :; done\nif [ -e \"$0.broken\" ]; then printf 'first\\nno such codec\\n\\n' >&2; "
             "exit 3; fi\nprintf '%s\\n' \"$@\" > \"$last\"\n");
  fs::permissions(program, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ("/nowhere:" + folder_.string() + ":" + path).c_str(), 1);
  EXPECT_NO_THROW(require_video(video));
  EXPECT_NO_THROW(require_video("a.mp4"));
  write_video(folder_ / "frames", 24, video);
  EXPECT_THAT(read_file(video), HasSubstr("-framerate\n24\n-i\n" + (folder_ / "frames/frame_%05d.png").string()));
  write_file(folder_ / "ffmpeg.broken", "");
  try {
    write_video(folder_ / "frames", 24, video);
    ADD_FAILURE() << "it ended with 3";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), video.string() + ": ffmpeg cannot write it: no such codec");
  }
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace nextview
