#include "core/file/readable_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace nextview {

void require_readable(const std::filesystem::path& folder) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(folder, ignored);
  if (::access(folder.c_str(), is_folder ? R_OK | X_OK : F_OK) == 0) return;
  const int error = errno;
  if (!is_folder && error != EACCES) return;  // which one has that lies in a folder that is locked
  const char* const advice = error == EACCES ? "; its owner can let you read it (chmod a+rX)" : "";
  throw std::runtime_error(
      fmt::format("{}: cannot be read: {}{}", folder.string(), std::generic_category().message(error), advice));
}

}  // namespace nextview
