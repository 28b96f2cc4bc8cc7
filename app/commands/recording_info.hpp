#pragma once
#include <filesystem>
#include <string>

#include "core/sensor/recorded_scans.hpp"

namespace nextview {

// What is told of scans that were recorded by `nextview info`.

std::string recording_info(const std::filesystem::path& path);
/// Stanford's range images as scenes to be scored.
std::string range_scans_info(const std::filesystem::path& folder);
std::string scene_info(const RecordedScene& scene);

/// Writes down what was guessed of a folder, to be corrected by hand; of one that nothing is known of, a template.
/// Returns what is told of it.
std::string write_dataset(const std::filesystem::path& folder);

}  // namespace nextview
