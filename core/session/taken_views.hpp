#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/config/configuration.hpp"

namespace nextview {

/// The poses that views.csv of a scan says were taken. Where that is a candidate's or the start view it is looked up,
/// as the text of a pose rounds.
/// @throws std::runtime_error with one line that names the file and, where it is wrong inside, the line.
std::vector<Pose> views_taken(const std::filesystem::path& file, std::span<const Pose> candidates, const Pose& start);
/// The same of a simulated scan with this configuration.
std::vector<Pose> views_taken(const std::filesystem::path& file, const Configuration& configuration);

}  // namespace nextview
