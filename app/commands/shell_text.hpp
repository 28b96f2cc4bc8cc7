#pragma once
#include <filesystem>
#include <string>

namespace nextview {

/// A path as it can be pasted behind an option in a shell: in quotes if it must be, and never taken for an option.
std::string shell_text(const std::filesystem::path& path);

}  // namespace nextview
