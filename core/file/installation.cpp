#include "core/file/installation.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Only the folder's name decides, not what lies around it: a copy in /tmp is not to load what others put there.
bool is_installed(const fs::path& program) { return program.parent_path().filename() == "bin"; }

}  // namespace

fs::path running_program(std::error_code& error) { return fs::read_symlink("/proc/self/exe", error); }

fs::path libraries_of(const fs::path& program) {
  const fs::path folder = program.parent_path();
  return is_installed(program) ? folder.parent_path() / "lib" / "nextview" : folder;
}

fs::path shared_folder(const std::string& name) {
  std::error_code error;
  const fs::path program = running_program(error);
  const fs::path folder = program.parent_path();
  const fs::path shared = (is_installed(program) ? folder.parent_path() : folder) / "share" / "nextview" / name;
  return !program.empty() && fs::is_directory(shared, error) ? shared : fs::path(NEXTVIEW_SHARE) / name;
}

}  // namespace nextview
