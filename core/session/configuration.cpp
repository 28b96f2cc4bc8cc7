#include "core/session/configuration.hpp"

#include <fmt/format.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/planner/gain_policies.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Files are small: toml++ takes a table apart by recursion, and a larger one could nest deeper than the stack.
constexpr std::uintmax_t largest_file = 1 << 15;

/// Where a file says that another one is: beside it, if there is one, or as it stands.
std::string beside(const fs::path& file, const std::string& said) {
  const fs::path there = file.parent_path() / said;
  std::error_code ignored;
  return !said.empty() && fs::path(said).is_relative() && fs::is_regular_file(there, ignored) ? there.string() : said;
}

/// A TOML value as a setting takes it. Whole numbers do for numbers; what stands in quotes is a text and nothing else.
std::string value_text(const Setting& setting, const toml::node& node) {
  const bool takes_text =
      std::holds_alternative<std::string*>(setting.value) || std::holds_alternative<Setting::Choice>(setting.value);
  if (takes_text != node.is_string())
    throw std::invalid_argument(
        fmt::format("{} takes {} quotes, as a single value", setting.key, takes_text ? "a text in" : "no"));
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  throw std::invalid_argument(setting.key + " takes a single value");
}

class TomlReader {
 public:
  /// With `only`, keys outside of that section are errors.
  TomlReader(const fs::path& file, Configuration& configuration, SettingSources& sources, std::string only = "")
      : file_(file),
        only_(std::move(only)),
        configuration_(configuration),
        sources_(sources),
        settings_(settings(configuration)) {
    for (const Setting& s : settings_) keys_.push_back(s.key);
  }

  void read(const std::string& text) {
    toml::table table;
    try {
      table = toml::parse(text, file_.string());
    } catch (const toml::parse_error& error) {
      throw failure(error.source().begin.line, std::string(error.description()));
    }
    // The preset first: what else the file says of the sensor overrides it.
    if (const auto* preset = table.at_path("sensor.preset").as_string(); preset && only_.empty()) try {
        apply_sensor_preset(configuration_, located("sensor.preset", preset->get()), &sources_);
      } catch (const std::runtime_error& error) {
        throw failure(preset->source().begin.line, error.what());
      }
    apply(table, "");
    configuration_.read_from.push_back(file_);
  }

 private:
  /// The text of a setting: what names a file is looked for beside this one.
  std::string located(const std::string& key, const std::string& text) const {
    const bool names_file =
        key == "object.file" || key == "views.file" || (key == "sensor.preset" && !is_there(named_sensor(text)));
    return names_file ? beside(file_, text) : text;
  }

  void apply(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (const auto* section = node.as_table(); section && prefix.empty()) {
        apply(*section, key + ".");
        continue;
      }
      const auto setting =
          std::find_if(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
      const auto line = node.source().begin.line;
      if (setting == settings_.end())
        throw failure(line, fmt::format("there is no setting '{}'; did you mean '{}'?", key, nearest(key, keys_)));
      if (!only_.empty() && (!key.starts_with(only_) || key == "sensor.preset"))
        throw failure(line, fmt::format("'{}' has no place in a file of {} settings", key, only_));
      try {
        setting->set(located(key, value_text(*setting, node)));
        sources_[key] = place(line);
      } catch (const std::invalid_argument& error) {
        throw failure(line, error.what());
      }
    }
  }

  std::string place(std::uint32_t line) const { return fmt::format("{}:{}", file_.string(), line); }
  std::runtime_error failure(std::uint32_t line, const std::string& reason) const {
    return std::runtime_error(place(line) + ": " + reason);
  }

  fs::path file_;
  std::string only_;
  Configuration& configuration_;
  SettingSources& sources_;
  std::vector<Setting> settings_;
  std::vector<std::string> keys_;
};

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

/// What a part says of its fields, "room: field must be …", said of the settings of this section: "map.hit must be …".
template <class Part>
void validate_section(const Part& part, const std::string& section) {
  try {
    part.validate();
  } catch (const std::invalid_argument& error) {
    const std::string reason = error.what();
    if (reason.starts_with(section)) throw;
    const auto room = reason.find(": ");
    throw std::invalid_argument(section + reason.substr(room == reason.npos ? 0 : room + 2));
  }
}

}  // namespace

PosteriorSamplerConfig posterior_sampler_config(const Configuration& c) {
  return posterior_sampler_config(c.gibbs, c.sensor.range_noise, ray_pitch(c.sensor), c.map.resolution, c.seed);
}

void Configuration::validate() const {
  validate_section(sensor, "sensor.");
  validate_section(cloud, "cloud.");
  validate_section(views, "views.");
  validate_section(termination, "termination.");
  validate_section(map.model, "map.");
  validate_section(gibbs, "gibbs.");
  const auto in = [](double value, double low, double high, const char* key, const char* unit) {
    require(value >= low && value <= high,
            fmt::format("{} must be from {} to {}{}, not {}", key, low, high, unit, value));
  };
  require(object.longest_side == 0.0 || (object.longest_side >= 1e-3 && object.longest_side <= 100.0),
          fmt::format("object.longest_side must be 0 or from 0.001 to 100 m, not {}", object.longest_side));
  in(map.resolution, 1e-4, 1.0, "map.resolution", " m");
  in(map.region_edge, 1e-3, 1000.0, "map.region_edge", " m");
  in(map.region_edge / map.resolution, 1.0, 512.0, "map.region_edge / map.resolution", " voxels");
  in(views.radius, 0.01, 100.0, "views.radius", " m");  // of the start view, whatever the layout
  in(planner.ray_columns, 1, 2000, "planner.ray_columns", "");
  in(planner.ray_rows, 1, 2000, "planner.ray_rows", "");
  in(planner.ray_length, 1e-3, 1000.0, "planner.ray_length", " m");
  in(planner.weights.gain, 0.0, 1e6, "planner.gain_weight", "");
  in(planner.weights.cost, 0.0, 1e6, "planner.cost_weight", "");
  in(planner.start_azimuth, -360.0, 360.0, "planner.start_azimuth", " deg");
  in(planner.start_elevation, -90.0, 90.0, "planner.start_elevation", " deg");
  in(evaluation.d_reg, 1e-5, 1.0, "evaluation.d_reg", " m");
  in(evaluation.surface_samples, 1, 10'000'000, "evaluation.surface_samples", "");
  in(history.memory, 0.0, 1024.0, "history.memory", "GiB");
  const auto names = policy_names();
  require(std::find(names.begin(), names.end(), planner.gain) != names.end(),
          fmt::format("there is no gain '{}'; did you mean '{}'?", planner.gain, nearest(planner.gain, names)));
  const PolicyNeeds needs = make_policy(planner)->needs();
  require(!needs.true_surface || evaluation.enabled,
          fmt::format("planner.gain {} knows the mesh: it needs evaluation.enabled", planner.gain));
  require(
      !needs.posterior || planner.semantics == Semantics::published,
      fmt::format("planner.gain {} has published semantics only: the reference code knows no Gibbs map", planner.gain));
  require(!map.model.range_dependent() || planner.semantics == Semantics::published,
          "map.hit_decay and map.miss_decay must be 0 with planner.semantics reference, whose map knows no range");
  constexpr auto largest = std::uint64_t(std::numeric_limits<std::int64_t>::max());
  require(seed <= largest,
          fmt::format("seed must be at most {}, the largest whole number of TOML, not {}", largest, seed));
  CombinedPolicy(planner.combined_weights);  // whether it can be read
}

Configuration read_configuration(const fs::path& file, const Configuration& base, SettingSources* sources) {
  Configuration configuration = base;
  SettingSources of_file;
  TomlReader(file, configuration, sources ? *sources : of_file).read(read_file(file, largest_file));
  if (!sources) validate(configuration, of_file);
  return configuration;
}

std::string to_toml(const Configuration& configuration) {
  Configuration copy = configuration;
  std::string text, section;
  for (const Setting& s : settings(copy)) {
    const auto dot = s.key.find('.');
    const std::string room = dot == std::string::npos ? "" : s.key.substr(0, dot);
    if (room != section) text += fmt::format("\n[{}]\n", room);
    section = room;
    std::ostringstream value;
    if (std::holds_alternative<std::string*>(s.value) || std::holds_alternative<Setting::Choice>(s.value))
      value << toml::value<std::string>(s.text());
    else
      value << s.text();
    text += fmt::format("{} = {}  # {}{}\n", s.key.substr(dot == std::string::npos ? 0 : dot + 1), value.str(), s.help,
                        s.unit.empty() ? "" : fmt::format(" [{}]", s.unit));
  }
  return text;
}

void apply_sensor_preset(Configuration& configuration, const std::string& preset, SettingSources* sources) {
  fs::path file = named_sensor(preset);
  if (!is_there(file)) file = preset;
  if (!is_there(file)) {
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(assets_folder() / "sensors")) known.push_back(entry.path().stem());
    std::sort(known.begin(), known.end());
    throw std::runtime_error(
        fmt::format("there is no sensor '{}'; there are {}, or give a file", preset, fmt::join(known, ", ")));
  }
  configuration.sensor = {};
  SettingSources of_file;
  if (sources) std::erase_if(*sources, [](const auto& source) { return source.first.starts_with("sensor."); });
  TomlReader(file, configuration, sources ? *sources : of_file, "sensor.").read(read_file(file, largest_file));
  configuration.sensor_preset = preset;
}

}  // namespace nextview
