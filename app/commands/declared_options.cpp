#include "app/commands/declared_options.hpp"

#include <algorithm>

#include "core/config/configuration.hpp"

namespace nextview {
namespace {

std::vector<std::string> split(const std::string& text, char at) { return CLI::detail::split(text, at); }

bool is_lower_case(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c >= 'a' && c <= 'z'; });
}

/// "{always,never}" of one_of, or "map|cloud".
std::vector<std::string> choices_of_type(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  if (begin != type.npos && end != type.npos) return split(type.substr(begin + 1, end - begin - 1), ',');
  const auto words = split(type, '|');
  return words.size() > 1 && std::ranges::all_of(words, is_lower_case) ? words : std::vector<std::string>{};
}

}  // namespace

bool is_setting(const CLI::Option& option) {
  return option.get_group() == "Settings" || option.get_group() == "Common settings";
}

std::vector<const CLI::Option*> own_options(const CLI::App& command) {
  std::vector<const CLI::Option*> own;
  for (const CLI::Option* option : command.get_options())
    if (!is_setting(*option) && !option->get_group().empty() && option->get_name() != "--help") own.push_back(option);
  return own;
}

std::string usage(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  const std::string type = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  return option.get_name() + (type.empty() ? "" : " ") + type.substr(0, type.find(':'));
}

std::string description(const CLI::Option& option) {
  const std::string value = option.get_default_str();
  return option.get_description() + (value.empty() ? "" : " (default " + value + ")");
}

std::vector<std::string> choices(const CLI::Option& option) {
  if (!is_setting(option)) return choices_of_type(option.get_type_name());
  std::vector<std::string> keys = option.get_lnames();
  for (const CLI::Option* same : option.get_excludes())  // of a short name: the one by its key
    keys.insert(keys.end(), same->get_lnames().begin(), same->get_lnames().end());
  Configuration configuration;
  for (const Setting& setting : settings(configuration))
    if (std::ranges::find(keys, setting.key) != keys.end()) {
      if (const auto* choice = std::get_if<Setting::Choice>(&setting.value)) return choice->names;
      if (std::holds_alternative<bool*>(setting.value)) return {"true", "false"};
    }
  return {};
}

}  // namespace nextview
