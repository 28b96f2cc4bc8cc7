#include "ui/window/window_preferences.hpp"

#include <algorithm>
#include <cmath>

#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

constexpr const char* file_name = "window.json";

}  // namespace

double usual_text_scale(int width, int height, int millimetres) {
  constexpr double usual = 96.0, fine = 130.0;  // pixels an inch
  constexpr double usual_height = 1440.0;       // [px] of a display whose text is as large as it should be
  const auto in_quarters = [](double scale) { return std::clamp(std::round(4 * scale) / 4, 1.0, 3.0); };
  const double per_inch = millimetres > 0 ? width / (millimetres / 25.4) : usual;
  // 96 is what display servers say that do not know.
  if (std::abs(per_inch - usual) < 1) return in_quarters(height / usual_height);
  return per_inch < fine ? 1.0 : in_quarters(per_inch / usual);
}

WindowPreferences read_preferences(const std::filesystem::path& state) {
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
    return {};
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
