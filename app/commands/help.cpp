#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "app/commands/commands.hpp"
#include "app/commands/man_page.hpp"
#include "app/commands/manual_tables.hpp"
#include "app/commands/shell_completion.hpp"
#include "core/config/asset_names.hpp"
#include "core/config/configuration.hpp"
#include "core/config/known_objects.hpp"
#include "core/export/export_kind.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/make_folder.hpp"
#include "core/gibbs/test_problems.hpp"
#include "core/setting/section_of.hpp"
#include "core/setting/setting.hpp"
#include "ui/demo/demo_window.hpp"
#include "ui/manual/manual.hpp"
#include "ui/manual/markdown.hpp"

namespace nextview {
namespace {

constexpr std::size_t usual_width = 100, widest = 120;  // [columns]

std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_width;
  return std::clamp<std::size_t>(size.ws_col, 40, widest);
}

void print_topics() {
  fmt::print(
      "The manual (nextview help TOPIC prints a page, and nextview help map.hit what a setting is; the window has it "
      "in its Help menu):\n\n");
  for (const std::string& topic : manual_topics()) fmt::print("  {:<14}{}\n", topic, read_manual_page(topic).title);
  fmt::print("\nThe options of a command: nextview COMMAND --help. The pages as files: {}\n", manual_folder().string());
}

void print_markdown(const std::string& text) { fmt::print("{}", plain_text(parse_markdown(text), terminal_width())); }

/// The rows of the table of the window's commands, by their names.
std::map<std::string, std::string> window_commands() {
  std::map<std::string, std::string> rows;
  std::istringstream table(demo_commands());
  const std::string begin = "| `";
  for (std::string row; std::getline(table, row);)
    if (row.starts_with(begin))
      rows[row.substr(begin.size(), row.find_first_of(" `", begin.size()) - begin.size())] = row;
  return rows;
}

/// All that help is there for: pages, subcommands, groups of settings and each of them, commands of the window.
std::vector<std::string> help_topics(const CLI::App& program) {
  std::vector<std::string> topics = manual_topics();
  for (const CLI::App* command : program.get_subcommands({})) topics.push_back(command->get_name());
  Configuration configuration;
  std::string group;
  for (const Setting& setting : settings(configuration)) {
    if (const std::string its = section_of(setting.key); its != group) topics.push_back(group = its);
    topics.push_back(setting.key);
  }
  for (const auto& [name, row] : window_commands()) topics.push_back(name);
  return topics;
}

/// A page, the options of a subcommand, what a setting is, or a group of them, or a command of the window.
void print_topic(const std::string& topic, const CLI::App& program) {
  const std::vector<std::string> pages = manual_topics();
  if (std::ranges::find(pages, topic) != pages.end())
    return print_markdown(read_manual_page(topic).text + "\n\n" + settings_page(topic));
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == topic) return fmt::print("{}", command->help("nextview"));
  if (const std::string page = settings_page(topic); !page.empty()) return print_markdown(page);
  const auto rows = window_commands();
  if (const auto found = rows.find(topic); found != rows.end())
    return print_markdown("| command of the window | key | does |\n|---|---|---|\n" + found->second +
                          "\n\nMore of them: `nextview help commands`.\n");
  const std::string hint = did_you_mean(topic, help_topics(program), ";");
  throw std::runtime_error(
      fmt::format("there is no topic '{}'{} {} nextview help", topic, hint, hint == ";" ? "see" : "See"));
}

/// The pages with their tables as the declarations say them now.
void write_pages(const std::filesystem::path& folder, const CLI::App& program) {
  make_folder(folder);
  for (const std::string& topic : manual_topics())
    write_file(folder / (topic + ".md"), with_tables(read_manual_page(topic).text, program));
}

/// What commands and options take beside files, for the shell to complete.
std::map<std::string, std::vector<std::string>> names_taken(const CLI::App& program) {
  const std::vector<std::string> objects(known_objects().begin(), known_objects().end());
  const std::vector<std::string> sensors = asset_names("sensors");
  std::vector<std::string> problems = {"list"}, exports;
  for (const TestProblem& problem : test_problems()) problems.emplace_back(problem.name);
  for (const ExportEntry& entry : export_entries()) exports.emplace_back(entry.name);
  return {{"help", help_topics(program)},
          {"demo", demo_names()},
          {"figure", figure_names()},
          {"scan", objects},
          {"window", objects},
          {"calibrate", objects},
          {"study", asset_names("studies")},
          {"export", exports},
          {"--problem", problems},
          {"--sensor", sensors},
          {"--sensor.preset", sensors},
          {"--config", asset_names("configurations")},
          {"--layers", {"object", "cloud", "map", "views", "rays", "region"}}};
}

}  // namespace

void add_help_command(CLI::App& program) {
  struct Arguments {
    std::string topic, folder;
    bool man_page = false, completion = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* app = program.add_subcommand("help", "Print the manual: its topics, the page of one, or what a setting is");
  app->add_option(
      "TOPIC", a->topic,
      "a page of the manual, a command, a setting, a group of settings, or a command of the window; without one, "
      "what there is");
  app->add_option("--write", a->folder,
                  "writes all pages into this folder, with the tables that are made from the program's declarations "
                  "made anew: what developers do after they changed one")
      ->type_name("DIR");
  app->add_flag("--man", a->man_page, "prints the page that `man nextview` shows");
  app->add_flag("--completion", a->completion, "prints what bash reads to complete commands and options");
  app->footer("Examples:\n  nextview help\n  nextview help planning\n  nextview help planner.cost_weight");
  app->callback([a, &program] {
    if (!a->folder.empty())
      write_pages(a->folder, program);
    else if (a->man_page)
      fmt::print("{}", man_page(program));
    else if (a->completion)
      fmt::print("{}", bash_completion(program, names_taken(program)));
    else if (a->topic.empty())
      print_topics();
    else
      print_topic(a->topic, program);
    throw CLI::RuntimeError(0);
  });
}

}  // namespace nextview
