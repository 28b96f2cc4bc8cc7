#include "core/file/descriptor.hpp"

#include <fmt/format.h>

#include <cstring>

namespace nextview {

std::runtime_error file_error(const std::filesystem::path& file, const char* verb, int error) {
  return std::runtime_error(fmt::format("{}: cannot be {}: {}", file.string(), verb, std::strerror(error)));
}

}  // namespace nextview
