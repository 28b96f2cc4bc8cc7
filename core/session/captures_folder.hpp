#pragma once
#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "core/file/descriptor.hpp"

namespace nextview {

/// Where this process's captures are while they are read, for nobody else to see. It goes with this; what processes
/// left that were killed goes with the next.
class CapturesFolder {
 public:
  /// Below the folder for temporary files. @throws std::system_error naming it
  explicit CapturesFolder(const std::filesystem::path& temporary);
  CapturesFolder(const CapturesFolder&) = delete;
  ~CapturesFolder();

  /// A name for the folder of one connection: captures of two must not meet.
  std::filesystem::path next() { return path_ / std::to_string(++count_); }

 private:
  pid_t owner_;
  std::filesystem::path path_;
  Descriptor lock_;
  std::atomic<int> count_ = 0;
};

}  // namespace nextview
