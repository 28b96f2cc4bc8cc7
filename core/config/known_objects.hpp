#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace nextview {

/// What `object.file` takes besides paths: the objects that the program knows.
std::span<const char* const> known_objects();

/// What people call the object of this file: the name of a known object, or the file's.
std::string object_name(const std::filesystem::path& file);
/// The same of recorded scans: the folder's name, or the file's.
std::string recording_name(const std::filesystem::path& recorded);

}  // namespace nextview
