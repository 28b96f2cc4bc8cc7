#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/dataset.hpp"

namespace nextview {

/// A description that nobody wrote, and what had to be guessed for it, a line each, for people.
struct GuessedDataset {
  DatasetDescription description;
  std::vector<std::string> guessed;
};

/// What a folder without dataset.toml seems to hold, by the names of its files: Stanford's range images (.conf), ViSP's
/// simulated castle, scenes of Princeton's Amazon Picking Challenge (cam.info.txt), 3DMatch or 7-Scenes (*.pose.txt),
/// TUM RGB-D (groundtruth.txt), clouds with poses, one scan graph. None if it is none of these.
/// @throws std::runtime_error naming a file that is damaged
std::optional<GuessedDataset> guess_dataset(const std::filesystem::path& folder);

/// What guess_dataset looks for, for people.
std::string known_datasets();

/// What a folder or file of recorded data is: what its dataset.toml says, or else a guess.
struct DescribedDataset {
  std::filesystem::path folder;  ///< that the patterns are relative to
  DatasetDescription description;
  std::vector<std::string> guessed;        ///< empty where dataset.toml says all
  std::filesystem::path description_file;  ///< dataset.toml, or empty
};

/// `path`: a folder, a dataset.toml, a scan graph (.graph, .log) or a scene (.txt).
/// @throws std::runtime_error in one line: missing, results of Nextview, unknown (it tells what was looked for)
DescribedDataset describe_dataset(const std::filesystem::path& path);

}  // namespace nextview
