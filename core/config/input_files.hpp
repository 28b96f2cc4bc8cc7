#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/configuration.hpp"
#include "core/results/input_file.hpp"

namespace nextview {

/// Whatever a configuration makes a run read: the object and the openings beside it, the views file, the files that the
/// configuration itself comes from, its sensor's among them. @throws std::runtime_error if there is no such object.
std::vector<InputFile> input_files(const Configuration& configuration);

/// Recorded scans: a file, or a folder and what lies in it.
std::vector<InputFile> recorded_files(const std::filesystem::path& recorded);

/// The JSON beside a mesh file, which may list the part's openings: part.json beside part.ply.
std::filesystem::path openings_file(const std::filesystem::path& object);

}  // namespace nextview
