#pragma once
#include <filesystem>
#include <string>

namespace nextview {

/// "frame_00001.png", counted from 1.
std::string frame_name(int number);

/// Makes a folder for numbered pictures. It may be absent, empty, or hold pictures of an earlier time, which go: else
/// they would be mixed with the new ones. @throws std::invalid_argument, std::runtime_error naming it and the reason if
/// anything else is in it, or it cannot be written to
void make_frame_folder(const std::filesystem::path& folder);

}  // namespace nextview
