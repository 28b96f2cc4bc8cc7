#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace nextview {

/// A test with a folder of its own, which goes away with it.
class InTemporaryFolder : public testing::Test {
 protected:
  InTemporaryFolder()
      : folder_(std::filesystem::temp_directory_path() /
                ("nextview_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~InTemporaryFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

}  // namespace nextview
