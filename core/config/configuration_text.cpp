#include "core/config/configuration_text.hpp"

#include <fmt/format.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "core/config/asset_names.hpp"
#include "core/file/nul_text.hpp"
#include "core/file/png_text.hpp"
#include "core/file/read_file.hpp"
#include "core/setting/mistyped_path.hpp"
#include "core/setting/section_of.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Texts are small: toml++ takes a table apart by recursion, and a larger one could nest deeper than the stack.
constexpr std::uintmax_t largest_text = 1 << 15;

/// @throws std::runtime_error "file:line: reason"
toml::table parsed(const std::string& text, const fs::path& file) {
  if (text.size() > largest_text)
    throw std::runtime_error(
        fmt::format("{}: has {} bytes of settings; at most {} are read", file.string(), text.size(), largest_text));
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}", file.string(), error.source().begin.line, std::string(error.description())));
  }
}

std::string settings_in(const fs::path& file) {
  if (file.extension() != ".png") return read_file(file, largest_text);
  std::string carried = png_configuration(file);
  if (carried.empty()) throw std::runtime_error(file.string() + ": is a picture that carries no settings of Nextview");
  return carried;
}

/// Where a file says that another one is: beside it, if there is one, or as it stands.
std::string beside(const fs::path& file, const std::string& said, bool may_be_folder) {
  const fs::path there = file.parent_path() / said;
  std::error_code ignored;
  const bool is_there = fs::is_regular_file(there, ignored) || (may_be_folder && fs::is_directory(there, ignored));
  return !said.empty() && fs::path(said).is_relative() && is_there ? there.string() : said;
}

bool is_study(const toml::table& table) {
  const auto is_block = [&](const char* key) { return table[key].is_array_of_tables(); };
  return is_block("planning") || is_block("maps");
}

/// What a setting takes that is no text: "a number [m]".
std::string bare_value(const Setting& setting) {
  if (std::holds_alternative<bool*>(setting.value)) return "true or false";
  return setting.unit.empty() ? "a number" : fmt::format("a number [{}]", setting.unit);
}

/// `all`: the configuration's own settings, which take a while to list.
void give_one_of(std::vector<Setting>& all, Configuration& configuration, const std::string& key,
                 const std::string& text, const std::string& name, const std::string& place) {
  const SettingSources here{{key, {name, place, text}}};
  try {
    if (key == "sensor.preset")
      apply_sensor_preset(configuration, text);
    else
      find_setting(all, key).set(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(as_given(error.what(), here));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(as_given(error.what(), here));
  }
  configuration.sources[key] = {name, place, find_setting(all, key).text()};
}

class TomlReader {
 public:
  /// With `only`, keys outside of that section are errors.
  TomlReader(const fs::path& file, Configuration& configuration, std::string only = "")
      : file_(file), only_(std::move(only)), configuration_(configuration), settings_(settings(configuration)) {}

  void read(const std::string& text) {
    const toml::table table = parsed(text, file_);
    if (is_study(table))
      throw std::runtime_error(
          fmt::format("{0}: is a study, not a configuration; use `nextview study {0}`", file_.string()));
    // The preset first: what else the file says of the sensor overrides it.
    if (const auto* preset = table.at_path("sensor.preset").as_string(); preset && only_.empty()) {
      require_text("sensor.preset", *preset);
      take("sensor.preset", preset->get(), preset->source().begin.line);
    }
    apply(table, "");
    configuration_.read_from.push_back(file_);
  }

 private:
  /// The text of a setting: what names a file is looked for beside this one.
  std::string located(const std::string& key, const std::string& text) const {
    constexpr std::array paths = {"object.file", "views.file", "map.start", "recorded.folder", "recorded.truth"};
    const bool names_file =
        std::ranges::find(paths, key) != paths.end() || (key == "sensor.preset" && !is_there(named_sensor(text)));
    return names_file ? beside(file_, text, key == "recorded.folder" || key == "views.file") : text;
  }

  void apply(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (const auto* section = node.as_table(); section && prefix.empty()) {
        apply(*section, key + ".");
        continue;
      }
      const auto line = node.source().begin.line;
      require_text(key, node);
      const Setting& setting = known(key, line);
      if (!only_.empty() && (!key.starts_with(only_) || key == "sensor.preset"))
        throw failure(line, fmt::format("'{}' has no place in a file of {} settings", key, only_));
      if (key == "sensor.preset" && node.is_string()) continue;  // is taken already
      take(key, value_text(setting, node), line);
    }
  }

  void require_text(const std::string& key, const toml::node& node) const {
    const std::string reason = why_no_text(key, node.value_or(std::string_view()));
    if (!reason.empty()) throw failure(node.source().begin.line, reason);
  }

  const Setting& known(const std::string& key, std::uint32_t line) try {
    return find_setting(settings_, key);
  } catch (const std::invalid_argument& error) {
    throw failure(line, error.what());
  }

  /// A value as a setting takes it. Whole numbers do for numbers; in quotes stand texts, and numbers with their unit.
  std::string value_text(const Setting& setting, const toml::node& node) const {
    const bool takes_text =
        std::holds_alternative<std::string*>(setting.value) || std::holds_alternative<Setting::Choice>(setting.value);
    const bool takes_unit = std::holds_alternative<double*>(setting.value) && !setting.unit.empty();
    const auto line = node.source().begin.line;
    if (node.is_string() ? !takes_text && !takes_unit : takes_text)
      throw failure(line, takes_text ? fmt::format("{} takes a text in quotes, as a single value", setting.key)
                                     : fmt::format("{} takes {}, without quotes", setting.key, bare_value(setting)));
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    throw failure(line, setting.key + " takes a single value");
  }

  void take(const std::string& key, const std::string& text, std::uint32_t line) {
    try {
      give_one_of(settings_, configuration_, key, located(key, text), key, place(line));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
  }
  std::string place(std::uint32_t line) const { return fmt::format("{}:{}", file_.string(), line); }
  std::runtime_error failure(std::uint32_t line, const std::string& reason) const {
    return std::runtime_error(place(line) + ": " + reason);
  }

  fs::path file_;
  std::string only_;
  Configuration& configuration_;
  std::vector<Setting> settings_;
};

}  // namespace

bool is_study(const std::string& toml) try {
  return is_study(parsed(toml, ""));
} catch (const std::runtime_error&) {  // who reads it tells where
  return false;
}

void give(Configuration& configuration, const std::string& key, const std::string& text, const std::string& name,
          const std::string& place) {
  auto all = settings(configuration);
  give_one_of(all, configuration, key, text, name, place);
}

void read_settings(const fs::path& file, Configuration& configuration) {
  TomlReader(file, configuration).read(settings_in(file));
}

Configuration configuration_of(const std::string& text, const fs::path& file) {
  Configuration configuration;
  TomlReader(file, configuration).read(text);
  configuration.validate();
  return configuration;
}

Configuration read_configuration(const fs::path& file, const Configuration& base) {
  Configuration configuration = base;
  read_settings(file, configuration);
  configuration.validate();
  return configuration;
}

std::string to_toml(const Configuration& configuration) {
  Configuration copy = configuration;
  std::string text, section;
  for (const Setting& s : settings(copy)) {
    const std::string room = section_of(s.key);
    if (room != section) text += fmt::format("\n[{}]\n", room);
    section = room;
    std::ostringstream value;
    if (std::holds_alternative<std::string*>(s.value) || std::holds_alternative<Setting::Choice>(s.value))
      value << toml::value<std::string>(s.text());
    else
      value << s.text();
    text += fmt::format("{} = {}  # {}\n", s.key.substr(s.key.find('.') + 1), value.str(), s.explanation());
  }
  return text;
}

void apply_sensor_preset(Configuration& configuration, const std::string& preset) {
  fs::path file = named_sensor(preset);
  if (!is_there(file)) file = preset;
  if (!is_there(file)) {
    const std::vector<std::string> known = asset_names("sensors");
    throw std::runtime_error(fmt::format(
        "sensor.preset: there is no sensor '{}'{}", preset,
        did_you_mean_path(preset, known, fmt::format("; there are {}, or give a file", fmt::join(known, ", ")))));
  }
  configuration.sensor = {};
  std::erase_if(configuration.sources, [](const auto& source) { return source.first.starts_with("sensor."); });
  TomlReader(file, configuration, "sensor.").read(read_file(file, largest_text));
  configuration.sensor_preset = preset;
}

}  // namespace nextview
