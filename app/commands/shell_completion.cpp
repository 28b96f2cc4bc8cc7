#include "app/commands/shell_completion.hpp"

#include <fmt/format.h>

#include <map>

#include "app/commands/declared_options.hpp"

namespace nextview {
namespace {

using Words = std::vector<std::string>;

// Sessions that the window keeps are known by their names, too, of which those that scanned the same part differ by the
// time before it. With `filenames` bash puts backslashes before blanks, and a slash behind folders.
constexpr std::string_view script = R"(# Made by `nextview help --completion` from what the program declares.
_nextview_sessions() {{
  local journal session
  for journal in "${{XDG_STATE_HOME:-$HOME/.local/state}}"/nextview/*/journal; do
    session=${{journal%/journal}}
    if [[ -e $journal && ($session == "$1"* || ${{session##*/}} == *"$1"*) ]]; then printf '%s\n' "$session"; fi
  done
}}
_nextview() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} option=${{COMP_WORDS[COMP_CWORD - 1]}} command='' words='' files='' i
  # --option=value is three words to bash
  if [ "$word" = = ]; then word=''; elif [ "$option" = = ]; then option=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  word=${{word//\\/}} word=${{word#[\"\']}}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in {}) command=${{COMP_WORDS[i]}}; break ;; esac
  done
  case $option in
{}  esac
  if [ -z "$words" ] && [[ $word == -* ]]; then
    case $command in
{}    esac
  elif [ -z "$words" ] && [[ $option != -* ]]; then
    case $command in
{}    esac
    case $command in help | posterior) ;; *) files=$(compgen -f -- "$word") ;; esac
    case $command in {}) files+=$'\n'$(_nextview_sessions "$word") ;; esac
  elif [ "$command $option" = 'scan --resume' ]; then
    files=$(compgen -d -- "$word"; _nextview_sessions "$word")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word"; printf '%s' "$files" | grep .)
  if [[ $files == *[!$'\n']* ]]; then compopt -o filenames 2>/dev/null; fi
}}
complete -o default -F _nextview nextview
)";

constexpr std::string_view takers_of_sessions = "export | score | figure | refine | calibrate | info | window";

Words long_options(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// A line of a `case`.
std::string when(const Words& patterns, const Words& words) {
  return fmt::format("    {}) words='{}' ;;\n", fmt::join(patterns, " | "), fmt::join(words, " "));
}

/// By the values that they may have: the options whose values have names.
std::map<Words, Words> options_by_choices(const CLI::App& program) {
  std::map<Words, Words> options;
  std::map<std::string, Words> known;
  for (const CLI::App* command : program.get_subcommands({}))
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames())
        if (const Words values = choices(*option); !values.empty() && known.emplace(name, values).second)
          options[values].push_back("--" + name);
  return options;
}

}  // namespace

std::string bash_completion(const CLI::App& program, const std::map<std::string, Words>& names) {
  Words commands;
  std::string of_commands, values, of_names;
  for (const CLI::App* command : program.get_subcommands({})) {
    const std::string& name = command->get_name();
    commands.push_back(name);
    // The window is also no command.
    of_commands += "  " + when({name == "window" ? "window | ''" : name}, long_options(*command));
  }
  for (const auto& [taker, words] : names)
    if (taker.starts_with("--"))
      values += when({taker}, words);
    else
      of_names += "  " + when({taker}, words);
  of_names += "  " + when({"''"}, commands);
  for (const auto& [words, options] : options_by_choices(program)) values += when(options, words);
  return fmt::format(script, fmt::join(commands, " | "), values, of_commands, of_names, takers_of_sessions);
}

}  // namespace nextview
