#pragma once
#include <filesystem>
#include <vector>

namespace nextview {

/// A folder that something is to be written to, made with those that it lies in. Which of them hold nothing in the end
/// are gone again: what fails or is stopped leaves nothing.
class MadeFolder {
 public:
  /// @throws std::runtime_error naming it and the reason, also if it cannot be written to
  explicit MadeFolder(const std::filesystem::path& folder);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace nextview
