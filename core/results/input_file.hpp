#pragma once
#include <filesystem>
#include <string>

namespace nextview {

/// A file or folder that a run reads.
struct InputFile {
  std::filesystem::path path;
  std::string what;  ///< for people: "the object that is scanned"
};

}  // namespace nextview
