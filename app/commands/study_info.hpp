#pragma once
#include <filesystem>
#include <string>

#include "core/study/study_folder.hpp"

namespace nextview {

/// What is told of a study's folder by `nextview info`: how far it is, what is done with it next, its objects.
std::string study_info(const std::filesystem::path& folder, const StudyContents& study);

}  // namespace nextview
