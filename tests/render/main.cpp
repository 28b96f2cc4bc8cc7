#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <exception>

#include "tests/render/window_picture.hpp"
#include "ui/render_target/headless.hpp"

/// The tests draw headless. With --draw-in-window FILE this program draws one picture in a window instead; the test
/// that compares the two starts it so.
int main(int argc, char** argv) {
  try {
    if (argc == 3 && std::strcmp(argv[1], "--draw-in-window") == 0) {
      nextview::draw_in_window(argv[2]);
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
