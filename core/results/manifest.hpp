#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/file/file_hash.hpp"

namespace nextview {

/// What manifest.json in a folder of results says: who wrote them, of which object, and their names. The names are
/// those that were about to be written, so a run that was ended in the middle may have left fewer.
struct Manifest {
  struct Object {
    std::string file;  ///< as in config.toml: relative to the folder if it lies inside, absolute otherwise
    FileHash hash;
  };
  std::string program;  ///< "nextview 0.4.0"
  std::string command;  ///< "scan", "refine", "calibrate"
  std::optional<Object> object;
  std::vector<std::string> files;
};

inline constexpr const char* manifest_name = "manifest.json";

/// None if there is none. Files that no version of Nextview writes are left out, so that whatever a manifest says,
/// nothing else can be removed by it. @throws std::runtime_error naming the file if it is not one of Nextview's.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);
/// @throws std::runtime_error naming the file and the reason.
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);

/// Whether this is a regular file itself: no link to one, no folder.
bool is_plain_file(const std::filesystem::path& path);

/// Every name that results have, but for the pictures of steps.
std::span<const std::string_view> fixed_result_names();
/// Whether results have this name: one of the above, step_01.png, …, or scans/0001.npy, …
bool is_result_name(std::string_view name);

/// The names of what version 0.4.0 and earlier ones, which wrote no manifest, have left in a folder. None unless there
/// is a config.toml and beside it a table that begins as the command's own does.
std::vector<std::string> results_without_manifest(const std::filesystem::path& folder);

}  // namespace nextview
