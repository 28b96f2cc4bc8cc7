#include "core/file/make_folder.hpp"

#include <stdexcept>
#include <system_error>

#include "core/file/descriptor.hpp"

namespace nextview {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error, ignored;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  if (std::filesystem::exists(folder, ignored))
    throw std::runtime_error(folder.string() + ": cannot be made a folder: there is a file of this name");
  throw file_error(folder, "made a folder", error.value());
}

}  // namespace nextview
