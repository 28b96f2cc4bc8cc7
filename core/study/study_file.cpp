#include <fmt/format.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/evaluation/baseline_maps.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/planner/policy.hpp"
#include "core/setting/section_of.hpp"
#include "core/study/study.hpp"

namespace nextview {
namespace {
namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = 1 << 15;  ///< [bytes] as of configurations: toml++ recurs into tables
constexpr std::size_t most_of_an_axis = 100'000;
constexpr std::int64_t largest_seed = std::numeric_limits<std::int64_t>::max();

/// What the blocks of a study say, or what is no matter of one.
constexpr std::array axis_settings = {"object.file", "seed", "recorded.folder", "recorded.truth", "driver.name"};

std::vector<std::string> known_maps() {
  std::vector<std::string> names;
  names.reserve(baseline_maps.size() + 2);
  for (const BaselineMapInfo& map : baseline_maps) names.emplace_back(map.name);
  names.insert(names.end(), {"gibbs", "calibrated"});
  return names;
}

class StudyReader {
 public:
  explicit StudyReader(const fs::path& file) : file_(file) {
    Configuration configuration;
    for (const Setting& setting : settings(configuration)) keys_.push_back(setting.key);
  }

  Study read() {
    study_.file = file_;
    study_.name = file_.stem().string();
    study_.text = read_file(file_, largest_file);
    toml::table table;
    try {
      table = toml::parse(study_.text, file_.string());
    } catch (const toml::parse_error& error) {
      throw std::runtime_error(
          fmt::format("{}:{}: {}", file_.string(), error.source().begin.line, std::string(error.description())));
    }
    const auto is_block = [](std::string_view key) { return key == "planning" || key == "maps"; };
    if (is_configuration(table))
      throw std::runtime_error(
          fmt::format("{0}: is a configuration, not a study; use `nextview scan --config {0}`", file_.string()));
    for (const bool blocks : {false, true})  // which use the names that all else gives
      for (const auto& [key, node] : table)
        if (is_block(key.str()) == blocks) read_entry(std::string(key.str()), node);
    std::ranges::stable_sort(study_.blocks, {}, [](const StudyBlock& b) { return b.part; });
    complete(study_);
    return std::move(study_);
  }

 private:
  /// A configuration has settings in their sections and nothing else; a study without its blocks compares nothing.
  bool is_configuration(const toml::table& table) const {
    const auto is_of_settings = [&](const auto& entry) {
      const std::string name(entry.first.str());
      return std::ranges::any_of(keys_, [&](const std::string& key) { return key == name || section_of(key) == name; });
    };
    return !table.empty() && std::all_of(table.begin(), table.end(), is_of_settings);
  }

  void read_entry(const std::string& key, const toml::node& node) {
    if (key == "name")
      study_.name = text_of(node, key);
    else if (key == "settings")
      study_.settings = settings_of(table_of(node, key), "");
    else if (key == "sensor" || key == "policy" || key == "map")
      read_variants(key, table_of(node, key));
    else if (key == "planning" || key == "maps")
      read_blocks(key == "planning" ? StudyPart::planning : StudyPart::maps, node);
    else
      throw unknown(node, key, {"name", "settings", "sensor", "policy", "map", "planning", "maps"});
  }

  void read_variants(const std::string& of, const toml::table& table) {
    auto& variants = of == "sensor" ? study_.sensors : of == "policy" ? study_.policies : study_.maps;
    for (const auto& [key, node] : table) {
      StudyVariant variant;
      const toml::table& of_variant = table_of(node, std::string(key.str()));
      const toml::node* configuration = of_variant.get("config");
      const toml::node* kind = of == "map" ? of_variant.get("kind") : nullptr;
      if (configuration && of == "sensor")
        throw failure(*configuration, "'config' is of policies and maps; a sensor has sensor.preset");
      if (configuration) variant.configuration = beside_study(file_, text_of(*configuration, "config"));
      if (kind) variant.kind = one_of(*kind, "kind", known_maps());
      variant.settings = settings_of(of_variant, "", {configuration, kind});
      variants[std::string(key.str())] = std::move(variant);
    }
  }

  /// Of all but some nodes. They are not taken out of a copy of the table: copies do not know their lines.
  std::vector<GivenSetting> settings_of(const toml::table& table, const std::string& prefix,
                                        const std::vector<const toml::node*>& but = {}) const {
    std::vector<GivenSetting> all;
    for (const auto& [name, node] : table) {
      if (std::ranges::find(but, &node) != but.end()) continue;
      const std::string key = prefix + std::string(name.str());
      if (const auto* section = node.as_table(); section && prefix.empty()) {
        const auto more = settings_of(*section, key + ".");
        all.insert(all.end(), more.begin(), more.end());
        continue;
      }
      if (std::ranges::find(keys_, key) == keys_.end()) throw unknown(node, key, keys_);
      if (std::ranges::find(axis_settings, key) != axis_settings.end())
        throw failure(node, fmt::format("'{}' is no setting of a study: its blocks say what is scanned", key));
      const bool names_file = key == "views.file" || key == "map.start" || key == "sensor.preset";
      const std::string text = value_text(node, key);
      all.push_back({key, names_file ? beside_study(file_, text) : text, place(node)});
    }
    return all;
  }

  void read_blocks(StudyPart part, const toml::node& node) {
    if (const auto* one = node.as_table()) return read_block(part, *one);
    const auto* several = node.as_array();
    if (!several) throw failure(node, fmt::format("'{}' is written as [[{}]]", name(part), name(part)));
    for (const toml::node& one : *several) read_block(part, table_of(one, std::string(name(part))));
  }

  void read_block(StudyPart part, const toml::table& table) {
    const bool plans = part == StudyPart::planning;
    StudyBlock block;
    block.part = part;
    block.place = place(table);
    block.sensors = {default_sensor};
    block.seeds = {1};
    block.views = {plans ? 12 : 20};
    block.starts = {plans ? "30 20" : ""};
    for (const auto& [name_of, node] : table) {
      const std::string key(name_of.str());
      if (key == "objects")
        block.objects = texts(node, key);
      else if (key == "sensors")
        block.sensors = texts(node, key);
      else if (key == (plans ? "policies" : "maps"))
        block.methods = methods(part, node, key);
      else if (key == "views")
        block.views = whole_numbers<int>(node, key, 1, 1000);
      else if (key == "seeds")
        block.seeds = whole_numbers<std::uint64_t>(node, key, 0, largest_seed);
      else if (key == "starts" && plans)
        block.starts = starts(node);
      else if (key == "reference")
        block.reference = text_of(node, key);
      else
        throw unknown(node, key,
                      {"objects", "sensors", plans ? "policies" : "maps", "views", "seeds", "starts", "reference"});
    }
    study_.blocks.push_back(std::move(block));
  }

  std::vector<std::string> methods(StudyPart part, const toml::node& node, const std::string& key) const {
    const auto& variants = part == StudyPart::planning ? study_.policies : study_.maps;
    std::vector<std::string> known = part == StudyPart::planning ? policy_names() : known_maps();
    for (const auto& [variant, ignored] : variants) known.push_back(variant);
    return list_of<std::string>(node, key, [&](const toml::node& one) { return one_of(one, key, known); });
  }

  std::vector<std::string> texts(const toml::node& node, const std::string& key) const {
    return list_of<std::string>(node, key, [&](const toml::node& one) {
      std::string text = text_of(one, key);
      if (text.empty() || std::ranges::any_of(text, [](unsigned char c) { return c < 0x20; }))
        throw failure(one, fmt::format("'{}' holds an empty name or a control character", key));
      return text;
    });
  }

  template <class Number>
  std::vector<Number> whole_numbers(const toml::node& node, const std::string& key, std::int64_t low,
                                    std::int64_t high) const {
    return list_of<Number>(node, key, [&](const toml::node& one) {
      const auto* number = one.as_integer();
      if (!number || number->get() < low || number->get() > high)
        throw failure(one, fmt::format("'{}' takes whole numbers from {} to {}", key, low, high));
      return Number(number->get());
    });
  }

  std::vector<std::string> starts(const toml::node& node) const {
    return list_of<std::string>(node, "starts", [&](const toml::node& one) {
      const auto* pair = one.as_array();
      if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number())
        throw failure(one, "'starts' takes pairs of azimuth and elevation [deg]: [[30, 20], [120, -20]]");
      return fmt::format("{:g} {:g}", *(*pair)[0].value<double>(), *(*pair)[1].value<double>());
    });
  }

  /// What `read` makes of each value. A single value counts as a list of one.
  template <class Value, class Read>
  std::vector<Value> list_of(const toml::node& node, const std::string& key, const Read& read) const {
    const auto* list = node.as_array();
    if (!list) return {read(node)};
    if (list->empty() || list->size() > most_of_an_axis)
      throw failure(node, fmt::format("'{}' must have from 1 to {} values", key, most_of_an_axis));
    std::vector<Value> all;
    for (const toml::node& one : *list) all.push_back(read(one));
    return all;
  }

  std::string one_of(const toml::node& node, const std::string& key, const std::vector<std::string>& known) const {
    std::string text = text_of(node, key);
    if (std::ranges::find(known, text) == known.end())
      throw failure(node, fmt::format("'{}' has no '{}'{}", key, text, did_you_mean(text, known)));
    return text;
  }

  std::string value_text(const toml::node& node, const std::string& key) const {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    throw failure(node, key + " takes a single value");
  }

  std::string text_of(const toml::node& node, const std::string& key) const {
    if (const auto* text = node.as_string()) return text->get();
    throw failure(node, fmt::format("'{}' takes a text in quotes", key));
  }

  const toml::table& table_of(const toml::node& node, const std::string& key) const {
    if (const auto* table = node.as_table()) return *table;
    throw failure(node, fmt::format("'{}' is a table", key));
  }

  std::string place(const toml::node& node) const {
    return fmt::format("{}:{}", file_.string(), node.source().begin.line);
  }
  std::runtime_error failure(const toml::node& node, const std::string& reason) const {
    return std::runtime_error(place(node) + ": " + printable(reason));
  }
  std::runtime_error unknown(const toml::node& node, const std::string& key,
                             const std::vector<std::string>& known) const {
    return failure(node, fmt::format("there is no '{}' here{}", key, did_you_mean(key, known)));
  }

  fs::path file_;
  std::vector<std::string> keys_;
  Study study_;
};

}  // namespace

Study read_study(const fs::path& file) { return StudyReader(file).read(); }

}  // namespace nextview
