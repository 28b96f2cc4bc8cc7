#include "core/file/unchanged.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/file/read_file.hpp"

namespace nextview {

void require_unchanged(const std::filesystem::path& file, const FileHash& was, const std::filesystem::path& folder) {
  if (!is_there(file))
    throw std::runtime_error(
        fmt::format("{}: is not there, and {} was scanned of it; put it back", file.string(), folder.string()));
  if (was == file_hash(file)) return;
  throw std::runtime_error(
      fmt::format("{}: has changed since {} was scanned of it; scan it again, or put the object back as it was",
                  file.string(), folder.string()));
}

}  // namespace nextview
