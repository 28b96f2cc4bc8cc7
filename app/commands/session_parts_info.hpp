#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace nextview {

/// A table of depths or ranges (.npy), as captures and recordings have them, for people.
/// @throws std::runtime_error naming the file and the reason
std::string depth_image_info(const std::filesystem::path& file);

/// What lies in a session's folder and says nothing of itself: its captures, its journal and its state; none of
/// all else.
/// @throws as session_info
std::optional<std::string> session_part_info(const std::filesystem::path& path);

}  // namespace nextview
