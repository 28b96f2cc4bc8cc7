#pragma once
#include <string>
#include <vector>

namespace nextview {

/// The files of settings that come with the program in one of its folders, by their names, sorted: "sensors",
/// "configurations", "studies". None where the folder cannot be read.
std::vector<std::string> asset_names(const char* folder);

}  // namespace nextview
