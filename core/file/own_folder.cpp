#include "core/file/own_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace nextview {

std::filesystem::path make_own_folder(std::string_view beginning, const std::filesystem::path& in) {
  std::string name = (in / beginning).string() + "XXXXXX";
  if (!::mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
  return name;
}

OwnFolder::~OwnFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace nextview
