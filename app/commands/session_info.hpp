#pragma once
#include <filesystem>
#include <string>

namespace nextview {

/// Of a folder with a journal, for people: its branches, what came of each, and what is lost; lines that begin with two
/// spaces. @throws as read_journal
std::string session_info(const std::filesystem::path& folder);

}  // namespace nextview
