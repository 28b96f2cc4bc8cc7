#include "core/results/made_folder.hpp"

#include "core/file/atomic_file.hpp"
#include "core/file/make_folder.hpp"

namespace nextview {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder) {
  for (fs::path path = folder; !path.empty() && !is_there(path); path = path.parent_path()) made_.push_back(path);
  make_folder(folder);
  require_writable_folder(folder);
}

MadeFolder::~MadeFolder() {
  std::error_code not_empty;
  for (const fs::path& path : made_) fs::remove(path, not_empty);
}

}  // namespace nextview
