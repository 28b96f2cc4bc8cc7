#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/man_page.hpp"
#include "app/commands/manual_tables.hpp"
#include "app/commands/shell_completion.hpp"
#include "core/config/configuration.hpp"
#include "core/config/known_objects.hpp"
#include "core/file/atomic_file.hpp"
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

/// A page, the options of a subcommand, or what a setting is, or a group of them.
void print_topic(const std::string& topic, const CLI::App& program) {
  auto known = manual_topics();
  if (std::ranges::find(known, topic) != known.end())
    return print_markdown(read_manual_page(topic).text + "\n\n" + settings_page(topic));
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == topic) return fmt::print("{}", command->help());
    known.push_back(command->get_name());
  }
  if (const std::string page = settings_page(topic); !page.empty()) return print_markdown(page);
  const bool is_key = topic.find('.') != topic.npos;
  Configuration configuration;
  for (const Setting& setting : settings(configuration)) {
    const std::string section = section_of(setting.key);
    known.push_back(is_key || section.empty() ? setting.key : section);
  }
  const std::string hint = did_you_mean(topic, known, ";");
  throw std::runtime_error(
      fmt::format("there is no topic '{}'{} {} nextview help", topic, hint, hint == ";" ? "see" : "See"));
}

/// The pages with their tables as the declarations say them now.
void write_pages(const std::filesystem::path& folder, const CLI::App& program) {
  std::filesystem::create_directories(folder);
  for (const std::string& topic : manual_topics())
    write_file(folder / (topic + ".md"), with_tables(read_manual_page(topic).text, program));
}

/// What commands take beside files, for the shell to complete.
std::map<std::string, std::vector<std::string>> names_taken() {
  const std::vector<std::string> objects(known_objects().begin(), known_objects().end());
  return {{"help", manual_topics()}, {"demo", demo_names()}, {"figure", figure_names()},
          {"scan", objects},         {"window", objects},    {"calibrate", objects}};
}

}  // namespace

void add_help_command(CLI::App& program) {
  struct Arguments {
    std::string topic, folder;
    bool man_page = false, completion = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* app = program.add_subcommand("help", "Print the manual: its topics, the page of one, or what a setting is");
  app->add_option("TOPIC", a->topic,
                  "a page of the manual, a command, a setting, or a group of settings; without one, what there is");
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
      fmt::print("{}", bash_completion(program, names_taken()));
    else if (a->topic.empty())
      print_topics();
    else
      print_topic(a->topic, program);
    throw CLI::RuntimeError(0);
  });
}

}  // namespace nextview
