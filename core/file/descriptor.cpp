#include "core/file/descriptor.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace nextview {

std::runtime_error file_error(const std::filesystem::path& file, const char* verb, int error) {
  const char* const advice = error == ENAMETOOLONG ? "; give a shorter one" : "";
  return std::runtime_error(fmt::format("{}: cannot be {}: {}{}", file.string(), verb, std::strerror(error), advice));
}

}  // namespace nextview
