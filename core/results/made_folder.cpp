#include "core/results/made_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/file/atomic_file.hpp"

namespace nextview {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder) {
  for (fs::path path = folder; !path.empty() && !is_there(path); path = path.parent_path()) made_.push_back(path);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: cannot be made a folder: {}", folder.string(),
                                         error ? error.message() : "there is a file of this name"));
  require_writable_folder(folder);
}

MadeFolder::~MadeFolder() {
  std::error_code not_empty;
  for (const fs::path& path : made_) fs::remove(path, not_empty);
}

}  // namespace nextview
