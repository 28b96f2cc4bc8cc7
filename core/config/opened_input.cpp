#include "core/config/opened_input.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"
#include "core/file/gzip_file.hpp"
#include "core/file/lower_case.hpp"
#include "core/file/same_file.hpp"
#include "core/mesh/mesh_types.hpp"
#include "core/sensor/recorded_scans.hpp"

namespace nextview {
namespace {

constexpr std::array<std::string_view, 2> scan_graphs = {".graph", ".log"};
constexpr std::array<std::string_view, 3> others = {".toml", ".png", ".pcd"};

template <std::size_t N>
bool ends_in_one_of(const std::array<std::string_view, N>& endings, const std::filesystem::path& file) {
  return std::ranges::find(endings, file.extension().string()) != endings.end();
}

bool is_scan_file(const std::filesystem::path& file) {
  return ends_in_one_of(scan_graphs, file) || is_scene_file(file);
}

bool is_recording(const std::filesystem::path& input) {
  if (is_scan_file(input)) return true;
  const bool is_name = std::ranges::find(known_objects(), input.string(),
                                         [](const char* name) { return std::string(name); }) != known_objects().end();
  std::error_code ignored;
  return !is_name && std::filesystem::is_directory(input, ignored);
}

}  // namespace

Configuration with_input(Configuration configuration, const std::filesystem::path& input) {
  if (input.extension() == ".toml") return read_configuration(input, configuration);
  if (input.extension() == ".png") return read_configuration(input);
  if (input.extension() == ".nextview")
    throw std::runtime_error(input.string() +
                             ": is a demo: `nextview demo` plays it, and in the window Demo > Play another");
  forget_fitted(configuration);
  configuration.recorded.folder = configuration.recorded.truth = configuration.recorded.start = "";
  if (is_recording(input))
    configuration.recorded.folder = input.string();
  else
    configuration.object.file = input.string();
  return configuration;
}

bool carries_settings(const std::filesystem::path& file) {
  return file.extension() == ".toml" || file.extension() == ".png";
}

Configuration with_next_input(Configuration configuration, const std::filesystem::path& input) {
  ObjectConfig& object = configuration.object;
  // Settings may name another object, too: what was set of this one is then not what they leave out.
  std::filesystem::path next = input;
  if (carries_settings(input)) next = with_input(configuration, input).object.file;
  if (next != object.file && !same_file(next, object.file)) {
    object.unit = LengthUnit::automatic;
    object.up = UpAxis::automatic;
    object.longest_side = 0.0;
    for (const char* key : {"object.unit", "object.up", "object.longest_side"}) configuration.sources.erase(key);
  }
  return with_input(std::move(configuration), input);
}

bool is_map(const std::filesystem::path& file) { return file.extension() == ".ot" || file.extension() == ".bt"; }

std::string not_an_input(const std::filesystem::path& file) {
  const std::filesystem::path unpacked = without_gz(file);
  if (is_scan_file(file) || is_map(file) || ends_in_one_of(others, unpacked)) return "";
  return not_a_mesh_type(lower_case_extension(unpacked));
}

}  // namespace nextview
