#include "ui/window/window_preferences.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

constexpr const char* file_name = "window.json";

}  // namespace

WindowPreferences read_preferences(const std::filesystem::path& state, const WindowPreferences& otherwise) {
  try {
    std::ifstream stream(state / file_name);
    const auto json = nlohmann::json::parse(stream);
    return {std::clamp(json.at("text_scale").get<double>(), 0.5, 4.0), json.at("guide").get<bool>()};
  } catch (const std::exception&) {
    return otherwise;
  }
}

void keep_preferences(const std::filesystem::path& state, const WindowPreferences& preferences) {
  try {
    if (state.empty()) return;
    std::filesystem::create_directories(state);
    const nlohmann::ordered_json json = {{"text_scale", preferences.text_scale}, {"guide", preferences.guide}};
    write_file(state / file_name, json.dump(2) + "\n");
  } catch (const std::exception&) {  // they are a comfort alone
  }
}

}  // namespace nextview
