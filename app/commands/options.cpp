#include "app/commands/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/config/asset_names.hpp"
#include "core/config/opened_input.hpp"
#include "core/file/read_file.hpp"
#include "core/session/untitled_sessions.hpp"
#include "core/setting/mistyped_path.hpp"
#include "core/setting/quantity.hpp"

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
    ShortName{"--recorded", "recorded.folder"},
    ShortName{"--truth", "recorded.truth"},
    ShortName{"--every", "recorded.every"},
    ShortName{"--start", "recorded.start"},
};

std::string describe(const Setting& setting) {
  std::string text = setting.explanation();
  if (setting.bounds) text += "; " + setting.bounds->text();
  if (const auto* choice = std::get_if<Setting::Choice>(&setting.value))
    text += fmt::format("; one of {}", fmt::join(choice->names, ", "));
  const std::string value = setting.text();
  return value.empty() ? text : fmt::format("{} (default {})", text, value);
}

bool is_toml(const std::filesystem::path& file) { return file.extension() == ".toml"; }

/// A file, or the name of one that comes with the program.
std::filesystem::path find_configuration(const std::string& name) {
  const auto named = assets_folder() / "configurations" / (name + ".toml");
  std::error_code error;
  if (!std::filesystem::is_regular_file(name, error) && is_there(named)) return named;
  if (std::filesystem::is_directory(name, error))
    throw std::runtime_error(
        fmt::format("--config: {0} is a folder; that of a session is given as {0}/config.toml", name));
  if (is_there(name)) return name;
  const std::vector<std::string> known = asset_names("configurations");
  throw std::runtime_error(fmt::format(
      "--config: there is no file '{}'{}", name,
      did_you_mean_path(name, known, fmt::format("; those that come with the program are {}", fmt::join(known, ", ")),
                        is_toml)));
}

}  // namespace

CLI::Validator not_empty() {
  return {[](std::string& text) { return std::string(text.empty() ? "is empty; give a name, or leave it out" : ""); },
          ""};
}

CLI::Validator kept_session() {
  return {[](std::string& text) {
            text = folder_of_kept(text).string();
            return std::string();
          },
          ""};
}

CLI::Validator quantity(const std::string& unit) {
  return {[unit](std::string& text) {
            double value = 0.0;
            if (!read_quantity(text, unit, value)) return fmt::format("takes {}, not '{}'", number_wanted(unit), text);
            text = fmt::format("{}", value);
            return std::string();
          },
          ""};
}

CLI::Validator within(const Bounds& bounds, const std::string& unit) {
  return {[=](std::string& text) {
            double value = 0.0;
            if (!read_quantity(text, unit, value) || !bounds.allow(value))
              return fmt::format("takes {}, not '{}'", bounds.text(unit), text);
            text = fmt::format("{}", value);
            return std::string();
          },
          bounds.text(unit)};
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return {[names](std::string& text) {
            const bool known = std::ranges::find(names, text) != names.end();
            return known ? "" : fmt::format("takes {}, not '{}'", fmt::join(names, " or "), text);
          },
          fmt::format("{{{}}}", fmt::join(names, ","))};
}

void ConfigurationOptions::add_to(CLI::App& app) {
  app.add_option(
         "OBJECT", object_,
         "mesh file (PLY, OBJ, STL, OFF, 3MF, glTF, …), or gearbox, bunny, slotted_plate, …; or recorded scans: "
         "a folder, .graph, .log or .txt")
      ->check(not_empty())
      ->transform(kept_session());
  add_settings_to(app, {""});
}

void ConfigurationOptions::add_settings_to(CLI::App& app, const std::vector<std::string>& prefixes) {
  prefixes_ = prefixes;
  app.add_option("--config", files_,
                 "configuration file (TOML), a picture that carries one, or paper, calibrated, new_surface or "
                 "published_bunny; may be given several times: "
                 "later ones override, options all")
      ->type_name("FILE")
      ->allow_extra_args(false);
  Configuration defaults;
  for (const Setting& setting : settings(defaults)) {
    if (!takes(setting.key)) continue;
    const std::string by_key = "--" + setting.key;
    const auto add = [&](const std::string& option, const std::string& name, const std::string& help) {
      const auto keep = [this, key = setting.key, name](const std::string& text) { given_[key] = {name, text}; };
      return app.add_option_function<std::string>(option, keep, help)
          ->type_name(setting.unit.empty() ? "VALUE" : setting.unit);
    };
    const auto brief = std::find_if(short_names.begin(), short_names.end(),
                                    [&](const ShortName& name) { return setting.key == name.key; });
    if (brief == short_names.end()) {
      add(by_key, by_key, describe(setting))->group("Settings");
    } else if (by_key == brief->name) {
      add(by_key, by_key, describe(setting))->group("Common settings");
    } else {
      CLI::Option* option = add(brief->name, fmt::format("{} ({})", brief->name, setting.key), describe(setting));
      option->group("Common settings");
      add(by_key, by_key, fmt::format("the same as {}", brief->name))->group("Settings")->excludes(option);
    }
  }
}

bool ConfigurationOptions::takes(const std::string& key) const {
  const auto begins = [&](const std::string& prefix) { return key.starts_with(prefix); };
  return std::any_of(prefixes_.begin(), prefixes_.end(), begins);
}

Configuration ConfigurationOptions::configuration() const {
  Configuration configuration = with_object();
  if (!configuration.recorded.truth.empty() && configuration.recorded.folder.empty())
    throw std::invalid_argument(
        configuration.as_given("recorded.truth: only recorded scans are compared with a mesh; give the recording, too "
                               "(--recorded), or leave it out"));
  return configuration;
}

Configuration ConfigurationOptions::with_object() const {
  Configuration configuration;
  apply_to(configuration);
  if (object_.empty()) return configuration;
  if (given_.contains("recorded.folder"))
    throw std::invalid_argument(fmt::format(
        "{}: recorded scans are no scan of an object; give --truth {} to compare them with it", object_, object_));
  const RecordedConfig recorded = configuration.recorded;
  configuration = with_input(std::move(configuration), object_);
  if (!configuration.recorded.folder.empty()) {  // the other options say how
    const std::string folder = configuration.recorded.folder;
    configuration.recorded = recorded;
    configuration.recorded.folder = folder;
  } else if (given_.contains("recorded.truth")) {
    configuration.recorded.truth = recorded.truth;  // to be refused
  }
  return configuration;
}

void ConfigurationOptions::apply_to(Configuration& configuration) const {
  Configuration read = configuration;
  for (const std::string& file : files_) read_settings(find_configuration(file), read);
  auto from = settings(read), to = settings(configuration);
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!takes(to[i].key)) continue;
    to[i].set(from[i].text());
    if (const auto source = read.sources.find(to[i].key); source != read.sources.end())
      configuration.sources[to[i].key] = source->second;
  }
  configuration.read_from = read.read_from;
  // The preset first: what else is given of the sensor overrides it.
  if (const auto preset = given_.find("sensor.preset"); preset != given_.end())
    give(configuration, preset->first, preset->second.text, preset->second.option);
  for (const auto& [key, given] : given_)
    if (key != "sensor.preset") give(configuration, key, given.text, given.option);
  configuration.validate();
}

}  // namespace nextview
