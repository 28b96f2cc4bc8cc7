#include "core/config/opened_input.hpp"

#include <algorithm>
#include <array>

#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"

namespace nextview {
namespace {

bool is_recording(const std::filesystem::path& input) {
  constexpr std::array endings = {".graph", ".log", ".txt"};
  if (std::ranges::find(endings, input.extension().string()) != endings.end()) return true;
  const bool is_name = std::ranges::find(known_objects(), input.string(),
                                         [](const char* name) { return std::string(name); }) != known_objects().end();
  std::error_code ignored;
  return !is_name && std::filesystem::is_directory(input, ignored);
}

}  // namespace

Configuration with_input(Configuration configuration, const std::filesystem::path& input) {
  if (input.extension() == ".toml") return read_configuration(input, configuration);
  forget_fitted(configuration);
  configuration.recorded.folder = configuration.recorded.truth = configuration.recorded.start = "";
  if (is_recording(input))
    configuration.recorded.folder = input.string();
  else
    configuration.object.file = input.string();
  return configuration;
}

}  // namespace nextview
