#include "app/commands/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

struct ShortName {
  const char* name;
  const char* key;
};
constexpr std::array short_names = {
    ShortName{"--gain", "planner.gain"},
    ShortName{"--views", "termination.views"},
    ShortName{"--seed", "seed"},
    ShortName{"--semantics", "planner.semantics"},
    ShortName{"--sensor", "sensor.preset"},
    ShortName{"--resolution", "map.resolution"},
};

std::string describe(const Setting& setting) {
  std::string text = setting.help;
  if (!setting.unit.empty()) text += fmt::format(" [{}]", setting.unit);
  if (const auto* choice = std::get_if<Setting::Choice>(&setting.value))
    text += fmt::format("; one of {}", fmt::join(choice->names, ", "));
  const std::string value = setting.text();
  return value.empty() ? text : fmt::format("{} (default {})", text, value);
}

/// A file, or the name of one that comes with the program.
std::filesystem::path find_configuration(const std::string& name) {
  const auto named = assets_folder() / "configurations" / (name + ".toml");
  std::error_code error;
  return !std::filesystem::is_regular_file(name, error) && is_there(named) ? named : std::filesystem::path(name);
}

}  // namespace

void ConfigurationOptions::add_to(CLI::App& app) {
  app.add_option("OBJECT", object_,
                 "mesh file (PLY, OBJ, STL, OFF, 3MF, glTF, …), or gearbox, bunny, slotted_plate, …");
  add_settings_to(app, {""});
}

void ConfigurationOptions::add_settings_to(CLI::App& app, const std::vector<std::string>& prefixes) {
  prefixes_ = prefixes;
  app.add_option("--config", files_,
                 "configuration file (TOML), or paper or calibrated; may be given several times: later ones override, "
                 "options all")
      ->type_name("FILE")
      ->allow_extra_args(false);
  static Configuration defaults;
  for (const Setting& setting : settings(defaults)) {
    if (!takes(setting.key)) continue;
    std::string option = "--" + setting.key, names = option;
    std::string group = "Settings";
    for (const auto& [name, key] : short_names)
      if (setting.key == key) {
        // The key itself stays an option where it is not the short name already.
        names = names == name ? names : fmt::format("{},{}", name, names);
        option = name;
        group = "Common settings";
      }
    const auto keep = [this, key = setting.key, option](const std::string& text) { given_[key] = {option, text}; };
    app.add_option_function<std::string>(names, keep, describe(setting))
        ->group(group)
        ->type_name(setting.unit.empty() ? "VALUE" : setting.unit);
  }
}

bool ConfigurationOptions::takes(const std::string& key) const {
  const auto begins = [&](const std::string& prefix) { return key.starts_with(prefix); };
  return std::any_of(prefixes_.begin(), prefixes_.end(), begins);
}

Configuration ConfigurationOptions::configuration() const {
  Configuration configuration;
  apply_to(configuration);
  if (!object_.empty()) configuration.object.file = object_;
  return configuration;
}

void ConfigurationOptions::apply_to(Configuration& configuration) const {
  Configuration read = configuration;
  SettingSources sources;
  for (const std::string& file : files_) read = read_configuration(find_configuration(file), read, &sources);
  auto from = settings(read), to = settings(configuration);
  for (std::size_t i = 0; i < to.size(); ++i)
    if (takes(to[i].key)) to[i].set(from[i].text());
  configuration.read_from = read.read_from;
  if (const auto preset = given_.find("sensor.preset"); preset != given_.end())
    apply_sensor_preset(configuration, preset->second.text, &sources);
  for (Setting& setting : to)
    if (const auto given = given_.find(setting.key); given != given_.end()) set(setting, given->second, sources);
  validate(configuration, sources);
}

void ConfigurationOptions::set(Setting& setting, const Given& given, SettingSources& sources) {
  try {
    setting.set(given.text);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(complaint_about(setting.key, given.option, error.what()));
  }
  sources[setting.key] = given.option;
}

}  // namespace nextview
