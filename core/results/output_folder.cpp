#include "core/results/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/same_file.hpp"
#include "core/file/unchanged.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What is in the folder under a name that results have.
std::vector<fs::path> result_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const std::string_view name : fixed_result_names()) files.push_back(folder / name);
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_result_name(entry->path().filename().string())) files.push_back(entry->path());
  for (fs::directory_iterator entry(folder / "scans", error), end; !error && entry != end; entry.increment(error))
    if (is_result_name("scans/" + entry->path().filename().string())) files.push_back(entry->path());
  return files;
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, std::span<const InputFile> inputs, std::string_view option)
    : folder_(std::move(folder)) {
  if (folder_.empty()) throw std::invalid_argument("the folder for the results has no name");
  std::error_code ignored;
  if (fs::is_symlink(folder_, ignored) && fs::status(folder_, ignored).type() == fs::file_type::not_found)
    throw std::runtime_error(
        fmt::format("{}: is a link to what is not there; remove it, or give another folder", folder_.string()));
  if (fs::exists(folder_, ignored) && !fs::is_directory(folder_, ignored))
    throw std::runtime_error(
        fmt::format("{}: cannot be made a folder: there is a file of this name", folder_.string()));
  require_no_input(inputs, option);
  read_manifest(folder_);
}

void OutputFolder::require_no_input(std::span<const InputFile> inputs, std::string_view option) const {
  const auto refuse = [&](const InputFile& input, const char* why) {
    throw std::invalid_argument(fmt::format("{}: is {}, {}; give another folder for the results, for example {}{}",
                                            input.path.string(), input.what, why, option,
                                            free_folder(folder_).string()));
  };
  const std::vector<fs::path> results = result_files(folder_);
  for (const InputFile& input : inputs) {
    if (same_file(folder_, input.path)) refuse(input, "and would be mixed with the results");
    if (std::any_of(results.begin(), results.end(), [&](const fs::path& r) { return same_file(r, input.path); }))
      refuse(input, "and the results would replace it");
  }
}

void OutputFolder::begin(const std::string& command, const std::optional<fs::path>& object) {
  const MadeFolder made = make();
  manifest_ = {"nextview " NEXTVIEW_VERSION, command, std::nullopt, {}};
  if (object) manifest_.object = {named_from(folder_, *object), file_hash(*object)};
  remove_earlier_results();
  write_manifest(manifest_, folder_);
}

void OutputFolder::go_on(const std::string& command) {
  const MadeFolder made = make();
  manifest_ = read_manifest(folder_).value_or(Manifest{"nextview " NEXTVIEW_VERSION, command, std::nullopt, {}});
  write_manifest(manifest_, folder_);
}

void OutputFolder::remove() const {
  remove_earlier_results();
  std::error_code ignored;
  if (is_plain_file(folder_ / manifest_name)) fs::remove(folder_ / manifest_name, ignored);
  fs::remove(folder_, ignored);
}

void OutputFolder::remove_earlier_results() const {
  const std::optional<Manifest> earlier = read_manifest(folder_);
  for (const std::string& name : earlier ? earlier->files : results_without_manifest(folder_)) {
    if (name == manifest_name || !is_plain_file(folder_ / name)) continue;  // links and folders of this name stay
    if (!fs::is_directory(fs::symlink_status((folder_ / name).parent_path())) && name.starts_with("scans/")) continue;
    std::error_code error;
    fs::remove(folder_ / name, error);
    if (error)
      throw std::runtime_error(fmt::format("{}: cannot be removed: {}", (folder_ / name).string(), error.message()));
  }
  std::error_code not_empty;
  if (fs::is_directory(fs::symlink_status(folder_ / "scans", not_empty))) fs::remove(folder_ / "scans", not_empty);
}

fs::path OutputFolder::claim(const std::string& name) {
  assert(is_result_name(name) && !manifest_.program.empty());
  if (std::find(manifest_.files.begin(), manifest_.files.end(), name) == manifest_.files.end()) {
    manifest_.files.push_back(name);
    write_manifest(manifest_, folder_);
  }
  return folder_ / name;
}

fs::path free_folder(const fs::path& folder) {
  fs::path base = folder.has_filename() ? folder : folder.parent_path();
  const std::string name = base.filename().string();
  if (name.empty() || name == "." || name == "..") base /= "results";
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(base, ignored))) return base;
  for (int number = 2;; ++number) {
    fs::path candidate = base.string() + fmt::format("-{}", number);
    if (!fs::exists(fs::symlink_status(candidate, ignored))) return candidate;
  }
}

std::string named_from(const fs::path& folder, const fs::path& file) {
  const fs::path relative = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  if (!relative.empty() && *relative.begin() != "..") return relative.string();
  const fs::path absolute = fs::absolute(file);
  return (same_file(absolute, absolute.lexically_normal()) ? absolute.lexically_normal() : absolute).string();
}

void require_same_object(const fs::path& folder, const fs::path& object) {
  const std::optional<Manifest> manifest = read_manifest(folder);
  if (manifest && manifest->object) require_unchanged(object, manifest->object->hash, folder);
}

}  // namespace nextview
