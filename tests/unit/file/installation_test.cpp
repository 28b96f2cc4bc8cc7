#include "core/file/installation.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(Installation, OnlyAProgramInAFolderBinHasItsLibrariesElsewhere) {
  EXPECT_EQ(libraries_of("/opt/nextview/bin/nextview"), "/opt/nextview/lib/nextview");
  EXPECT_EQ(libraries_of("/work/build/release/nextview"), "/work/build/release");
  EXPECT_EQ(libraries_of("/tmp/nextview"), "/tmp") << "what others put into /lib or /tmp/lib is not loaded";
}

TEST(Installation, AProgramOfTheBuildFindsTheFilesBesideIt) {
  std::error_code error;
  const auto folder = running_program(error).parent_path() / "share" / "nextview";
  EXPECT_FALSE(error);
  EXPECT_EQ(shared_folder("assets"), folder / "assets");
  EXPECT_TRUE(std::filesystem::exists(shared_folder("shaders") / "voxels.glsl"));
}

// As for a program of someone else's, which has no such folder beside it.
TEST(Installation, WhatIsNotBesideTheProgramIsWhereNextviewWasToBeInstalled) {
  EXPECT_EQ(shared_folder("no such folder").parent_path().filename(), "nextview");
  EXPECT_TRUE(shared_folder("no such folder").is_absolute());
}

}  // namespace
}  // namespace nextview
