#include <gtest/gtest.h>

#include <cstdio>
#include <exception>

#include "ui/render_target/headless.hpp"

int main(int argc, char** argv) {
  try {
    nextview::ensure_headless(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
