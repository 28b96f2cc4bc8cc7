#pragma once
#include <filesystem>

namespace nextview {

/// Where the objects lie that come with the program.
inline const std::filesystem::path own_objects = std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/objects";

}  // namespace nextview
