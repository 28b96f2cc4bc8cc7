#include "core/results/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/file/whole_number.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_manifest = std::uintmax_t{16} << 20;  // [bytes] frames of a demo are many

constexpr std::array<std::string_view, 39> names = {"calibration.json",
                                                    "calibration.png",
                                                    "cameras.json",
                                                    "cloud.ply",
                                                    "config.toml",
                                                    "conventional.ot",
                                                    "descent.csv",
                                                    "journal",
                                                    manifest_name,
                                                    "map.bt",
                                                    "map.ot",
                                                    "metrics.json",
                                                    "orders.csv",
                                                    "new_surface.toml",
                                                    "posterior.bt",
                                                    "posterior.ot",
                                                    "refinement.csv",
                                                    "refinement.png",
                                                    "scores.csv",
                                                    "sensor_model.toml",
                                                    "sensor_models.png",
                                                    "steps.csv",
                                                    "surface_cloud.ply",
                                                    "surface_cloud.png",
                                                    "surface_cloud.stl",
                                                    "surface_map.ply",
                                                    "surface_map.png",
                                                    "surface_map.stl",
                                                    "surfaces.json",
                                                    "surface_map_unseen.stl",
                                                    "surface_cloud_unseen.stl",
                                                    "timings.csv",
                                                    "trace.csv",
                                                    "state",
                                                    "views.csv",
                                                    "surface_posterior.ply",
                                                    "surface_posterior.png",
                                                    "surface_posterior.stl",
                                                    "surface_posterior_unseen.stl"};

/// What 0.4.0 wrote, by the table that tells its command.
struct FormerResults {
  const char* table;
  std::string_view begins;
  std::vector<std::string_view> names;
};

const std::array<FormerResults, 3>& former_results() {
  static const std::array<FormerResults, 3> all = {{
      {"steps.csv",
       "step,view,",
       {"config.toml",
        "steps.csv",
        "scores.csv",
        "views.csv",
        "timings.csv",
        "metrics.json",
        "map.ot",
        "map.bt",
        "cloud.ply",
        "refinement.csv",
        "posterior.ot",
        "surface_map.ply",
        "surface_map.stl",
        "surface_map.png",
        "surface_posterior.ply",
        "surface_posterior.stl",
        "surface_posterior.png",
        "surface_cloud.ply",
        "surface_cloud.stl",
        "surface_cloud.png",
        "surfaces.json"}},
      {"trace.csv",
       "chain,sweep,",
       {"config.toml", "trace.csv", "scores.csv", "metrics.json", "timings.csv", "conventional.ot", "posterior.ot",
        "posterior.bt", "refinement.png", "sensor_models.png", "surface_posterior.ply", "surface_posterior.stl",
        "surface_posterior.png", "surface_cloud.ply", "surface_cloud.stl", "surface_cloud.png", "surfaces.json"}},
      {"descent.csv",
       "iteration,",
       {"config.toml", "descent.csv", "scores.csv", "sensor_model.toml", "calibration.json", "calibration.png"}},
  }};
  return all;
}

/// BEGIN, a number of at least so many digits and no more noughts than those ask for, END.
bool is_numbered(std::string_view name, std::string_view begin, std::size_t digits, std::string_view end) {
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + digits + end.size())
    return false;
  const std::string_view number = name.substr(begin.size(), name.size() - begin.size() - end.size());
  const bool all_digits = std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  return all_digits && (number.size() == digits || (number.size() <= 9 && number[0] != '0'));
}

/// step_01.png, step_100.png: as they are numbered, not step_1.png.
bool is_step_picture(std::string_view name) { return is_numbered(name, "step_", 2, ".png"); }

/// frame_00001.png, of a demo.
bool is_frame(std::string_view name) { return is_numbered(name, "frame_", 5, ".png"); }

bool is_capture(std::string_view name) {
  return is_numbered(name, "scans/", 4, ".npy") || is_numbered(name, "scans/", 4, ".ply");
}

bool begins_with(const fs::path& file, std::string_view text) {
  if (!is_plain_file(file)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string begin(text.size(), '\0');
  return in.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == text;
}

Manifest manifest_of(const Json& json) {
  Manifest manifest;
  json.at("program").get_to(manifest.program);
  json.at("command").get_to(manifest.command);
  if (!manifest.program.starts_with("nextview ")) throw std::runtime_error("another program's");
  if (const auto object = json.find("object"); object != json.end()) {
    manifest.object.emplace();
    object->at("file").get_to(manifest.object->file);
    manifest.object->hash.bytes = whole_number<std::uintmax_t>(object->at("bytes"));
    object->at("crc32").get_to(manifest.object->hash.crc32);
  }
  const Json& files = json.at("files");
  if (!files.is_array()) throw std::runtime_error("no list");
  for (const Json& name : files)
    if (name.is_string() && is_result_name(name.get_ref<const std::string&>())) manifest.files.push_back(name);
  return manifest;
}

}  // namespace

bool is_plain_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(path, error));
}

std::span<const std::string_view> fixed_result_names() { return names; }

bool is_result_name(std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end() || is_step_picture(name) || is_frame(name) ||
         is_capture(name);
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
  const fs::path file = folder / manifest_name;
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return std::nullopt;
  try {
    if (!is_plain_file(file)) throw std::runtime_error("no file");
    return manifest_of(parse_json<Json>(read_file(file, largest_manifest)));
  } catch (const std::exception&) {  // the reader's own messages quote the file's bytes, whatever they are
    throw std::runtime_error(fmt::format(
        "{}: is no list of results by Nextview; give another folder, or move this file away", file.string()));
  }
}

void write_manifest(const Manifest& manifest, const fs::path& folder) {
  Json json = {{"program", manifest.program}, {"command", manifest.command}};
  if (const auto& object = manifest.object)
    json["object"] = {{"file", object->file}, {"bytes", object->hash.bytes}, {"crc32", object->hash.crc32}};
  json["files"] = manifest.files;
  write_file(folder / manifest_name, json_text(json, 2) + "\n");
}

std::vector<std::string> results_without_manifest(const fs::path& folder) {
  std::vector<std::string> found;
  if (!is_plain_file(folder / "config.toml")) return found;
  for (const FormerResults& former : former_results()) {
    if (!begins_with(folder / former.table, former.begins)) continue;
    found.insert(found.end(), former.names.begin(), former.names.end());
    if (former.begins != "step,view,") continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_step_picture(entry.path().filename().string())) found.push_back(entry.path().filename());
  }
  return found;
}

}  // namespace nextview
