#include "core/config/known_objects.hpp"

#include <array>
#include <stdexcept>

#include "core/config/configuration.hpp"

namespace nextview {
namespace {

// In an order that finds the default object's own name where the gearbox is not installed and another takes its place.
constexpr std::array names = {"slotted_housing", "slotted_plate", "gearbox", "bunny", "sphere", "box"};

}  // namespace

std::span<const char* const> known_objects() { return names; }

std::string object_name(const std::filesystem::path& file) {
  for (const char* name : names) {
    try {
      if (resolve_object(name) == file) return name;
    } catch (const std::runtime_error&) {
      continue;  // this object is not installed
    }
  }
  return file.stem().string();
}

std::string recording_name(const std::filesystem::path& recorded) {
  const auto path = std::filesystem::absolute(recorded).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).stem().string();
}

}  // namespace nextview
