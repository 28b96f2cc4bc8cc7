#include "core/config/opened_input.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/config/configuration_text.hpp"
#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"
#include "core/file/png_text.hpp"

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
  if (input.extension() == ".png") {
    const std::string text = png_configuration(input);
    if (text.empty()) throw std::runtime_error(input.string() + ": is a picture that carries no settings of Nextview");
    return configuration_of(text, input);
  }
  forget_fitted(configuration);
  configuration.recorded.folder = configuration.recorded.truth = configuration.recorded.start = "";
  if (is_recording(input))
    configuration.recorded.folder = input.string();
  else
    configuration.object.file = input.string();
  return configuration;
}

}  // namespace nextview
