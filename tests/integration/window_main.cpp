#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "tests/integration/demo_in_window.hpp"
#include "ui/render_target/headless.hpp"

/// The tests draw headless. With --play-in-window DEMO WxH FPS FILE this program plays a demo in a window instead.
int main(int argc, char** argv) {
  try {
    if (argc == 6 && std::strcmp(argv[1], "--play-in-window") == 0) {
      const nextview::DemoPictures pictures{nextview::picture_size(argv[3], "--play-in-window"), std::atoi(argv[4])};
      nextview::write_frame_hashes_of_window(argv[2], pictures, argv[5]);
      return 0;
    }
    nextview::ensure_headless(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
