#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/config/configuration.hpp"

namespace nextview {

/// Configuration files of a folder that goes with the test.
class ConfigurationFile : public testing::Test {
 protected:
  ConfigurationFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("nextview_configuration_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~ConfigurationFile() override { std::filesystem::remove_all(folder_); }

  Configuration read(const std::string& text, const Configuration& base) const {
    std::ofstream(file(), std::ios::binary) << text;
    Configuration configuration = base;
    read_settings(file(), configuration);
    return configuration;
  }
  Configuration read(const std::string& text) const {
    const Configuration defaults;
    return read(text, defaults);
  }
  /// Why the text is refused: one line that names the file. Empty if it is read.
  std::string reason(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file().string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }
  /// What an error says.
  static std::string complaint(const std::function<void()>& action) {
    try {
      action();
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  std::filesystem::path file() const { return folder_ / "scan.toml"; }
  std::filesystem::path folder_;
};

inline std::vector<std::string> texts(const Configuration& configuration) {
  Configuration copy = configuration;
  std::vector<std::string> result;
  for (const Setting& s : settings(copy)) result.push_back(s.key + " = " + s.text());
  return result;
}

inline std::vector<std::string> default_texts() {
  const Configuration defaults;
  return texts(defaults);
}

}  // namespace nextview
