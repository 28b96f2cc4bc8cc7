#pragma once
#include <filesystem>

namespace nextview {

/// Makes a folder, with those that it lies in, unless it is there. @throws std::runtime_error naming it and the reason
void make_folder(const std::filesystem::path& folder);

}  // namespace nextview
