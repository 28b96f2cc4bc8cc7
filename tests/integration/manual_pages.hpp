#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

/// README, changelog and all files of the manual.
std::vector<std::filesystem::path> manual_pages();

/// The command lines of a page, without comments: of its blocks of "sh", or of those alone that are marked to be run,
/// "sh run".
std::vector<std::string> shell_lines(const std::filesystem::path& page, bool to_be_run);

}  // namespace nextview
