#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {

/// Sessions of the window, kept in a folder that goes with the test.
class KeptSessionTest : public InTemporaryFolder {
 protected:
  std::filesystem::path state() const { return folder_ / "state"; }
  std::vector<std::filesystem::path> kept() const {
    std::vector<std::filesystem::path> sessions;
    if (std::filesystem::exists(state()))
      for (const auto& entry : std::filesystem::directory_iterator(state()))
        if (entry.is_directory()) sessions.push_back(entry.path());  // beside them is the list of recent files
    return sessions;
  }
  std::unique_ptr<SessionRunner> runner() {
    auto runner = std::make_unique<SessionRunner>();
    runner->keep_sessions(state(), [this](const std::string& line) { notices_.push_back(line); });
    return runner;
  }
  static void steps(SessionRunner& runner, int count) {
    for (int k = 0; k < count; ++k) runner.step(job_control());
  }
  std::vector<std::string> notices_;
};

}  // namespace nextview
