#include "ui/window/window_preferences.hpp"

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

constexpr const char* file_name = "window.json";

}  // namespace

WindowPreferences read_preferences(const std::filesystem::path& state, const WindowPreferences& otherwise) {
  try {
    const auto json = parse_json<nlohmann::json>(read_file(state / file_name));
    const auto size = [&](const char* name, double usual) {
      return std::clamp(json.value(name, usual), PlaceSizes::smallest, PlaceSizes::largest);
    };
    constexpr PlaceSizes usual;
    return {std::clamp(json.at("text_scale").get<double>(), 0.5, 4.0),
            json.at("guide").get<bool>(),
            json.value("dark", false),
            {size("left", usual.left), size("right", usual.right), size("lower", usual.lower)}};
  } catch (const std::exception&) {
    return otherwise;
  }
}

void keep_preferences(const std::filesystem::path& state, const WindowPreferences& preferences) {
  try {
    if (state.empty()) return;
    std::filesystem::create_directories(state);
    const nlohmann::ordered_json json = {{"text_scale", preferences.text_scale},
                                         {"guide", preferences.guide},
                                         {"dark", preferences.dark},
                                         {"left", preferences.place_sizes.left},
                                         {"right", preferences.place_sizes.right},
                                         {"lower", preferences.place_sizes.lower}};
    write_file(state / file_name, json_text(json, 2) + "\n");
  } catch (const std::exception&) {  // they are a comfort alone
  }
}

}  // namespace nextview
