#include "app/commands/manual_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "app/commands/declared_options.hpp"
#include "app/commands/protocol_example.hpp"
#include "core/config/configuration.hpp"
#include "core/setting/section_of.hpp"
#include "ui/demo/demo_window.hpp"

namespace nextview {
namespace {

/// As a cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string first_upper(std::string text) {
  if (!text.empty()) text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string values_of(const Setting& setting) {
  if (const auto* choice = std::get_if<Setting::Choice>(&setting.value))
    return fmt::format("{}", fmt::join(choice->names, ", "));
  if (setting.bounds) return setting.bounds->text(setting.unit);
  const bool is_list = std::holds_alternative<std::string*>(setting.value) && !setting.unit.empty();
  return is_list ? fmt::format("numbers [{}]", setting.unit) : setting.unit;
}

/// A table a group of keys: "sensor.", "map.", …; those without a group first. Of all keys, or of those that are asked
/// for by key or group.
std::string settings_tables(const std::string& only = "") {
  Configuration configuration;
  std::string tables, group = "-";
  for (const Setting& setting : settings(configuration)) {
    const std::string its = section_of(setting.key);
    if (!only.empty() && only != setting.key && only != its) continue;
    if (its != group) {
      group = its;
      tables += fmt::format("{}## {}\n\n| key | is | may be | default |\n|---|---|---|---|\n",
                            tables.empty() ? "" : "\n", its.empty() ? "General" : first_upper(its));
    }
    tables += fmt::format("| `{}` | {} | {} | {} |\n", setting.key, cell(setting.help), cell(values_of(setting)),
                          cell(setting.text()));
  }
  return tables;
}

/// What a subcommand takes of the settings, as a row; none if it takes none: "`--gibbs.KEY VALUE`".
std::string settings_row(const CLI::App& command) {
  Configuration configuration;
  std::size_t taken = 0;
  std::vector<std::string> groups;
  const auto all = settings(configuration);
  for (const Setting& setting : all) {
    const CLI::Option* option = command.get_option_no_throw("--" + setting.key);
    if (!option || !is_setting(*option)) continue;  // of posterior the seed is its own
    ++taken;
    const std::string group = section_of(setting.key);
    groups.push_back(group.empty() ? setting.key : group + ".KEY");
  }
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  if (taken == 0) return "";
  if (taken == all.size()) return "| `--KEY VALUE` | any setting by its key |\n";
  return fmt::format("| `--{} VALUE` | settings by their keys |\n", fmt::join(groups, "`, `--"));
}

/// A heading and a table a subcommand; settings have a page of their own.
std::string options_tables(const CLI::App& program) {
  std::string tables;
  for (const CLI::App* command : program.get_subcommands({})) {
    tables += fmt::format("{}## nextview {}\n\n{}.\n\n| option | does |\n|---|---|\n", tables.empty() ? "" : "\n",
                          command->get_name(), command->get_description());
    for (const CLI::Option* option : own_options(*command))
      tables += fmt::format("| `{}` | {} |\n", cell(usage(*option)), cell(description(*option)));
    for (const CLI::App* part : command->get_subcommands({}))
      tables += fmt::format("| `{}` | {} |\n", part->get_name(), cell(part->get_description()));
    tables += settings_row(*command);
  }
  return tables;
}

std::string table(const std::string& name, const CLI::App& program) {
  if (name == "commands") return demo_commands();
  if (name == "settings") return settings_tables();
  if (name == "options") return options_tables(program);
  if (name == "protocol") return "```text\n" + protocol_example() + "```\n";
  throw std::runtime_error("the manual has a table of the name '" + name + "', which nothing makes");
}

}  // namespace

std::string settings_page(const std::string& key_or_group) {
  const std::string tables = settings_tables(key_or_group);
  if (tables.empty()) return "";
  return tables +
         "\nEach is an option of the commands that use it (`--KEY VALUE`), and may stand in a file for `--config`: "
         "`nextview help settings`. Lengths that are not given suit the object's size; the default is that of half a "
         "metre.\n";
}

std::string with_tables(const std::string& page, const CLI::App& program) {
  constexpr std::string_view begin = "<!-- table: ", end = "<!-- end -->";
  std::string result;
  std::size_t done = 0;
  for (std::size_t at; (at = page.find(begin, done)) != page.npos;) {
    const std::size_t name = at + begin.size(), name_end = page.find(" -->", name), old_end = page.find(end, name);
    if (name_end == page.npos || old_end == page.npos) throw std::runtime_error("a table of the manual has no end");
    result += page.substr(done, name_end + 4 - done) + "\n\n";
    result += table(page.substr(name, name_end - name), program) + "\n";
    done = old_end;
  }
  return result + page.substr(done);
}

}  // namespace nextview
