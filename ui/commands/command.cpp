#include "ui/commands/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

bool parse_number(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void check(const Command& command, const Argument& argument, const std::string& text) {
  using Kind = Argument::Kind;
  const auto wrong = [&](const std::string& wanted) {
    return std::invalid_argument(
        fmt::format("{}: {} must be {}, not '{}'", command.name, upper_case(argument.name), wanted, text));
  };
  if (argument.kind == Kind::number || argument.kind == Kind::whole) {
    double value = 0;
    const bool whole = argument.kind == Kind::whole;
    if (!parse_number(text, value) || !(value >= argument.low && value <= argument.high) ||
        (whole && value != std::floor(value)))
      throw wrong(fmt::format("a {}number from {:g} to {:g}", whole ? "whole " : "", argument.low, argument.high));
  } else if (argument.kind == Kind::choice) {
    const auto choices = argument.choices({});
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      throw wrong(fmt::format("one of {}", fmt::join(choices, ", ")));
  } else if (argument.kind == Kind::file && text.empty()) {
    throw wrong("given");
  }
}

/// What stands between double quotes, in which two of them mean one. `begin` is behind the first, and in the end behind
/// the last.
std::string quoted_word(std::string_view line, std::size_t& begin) {
  std::string word;
  for (;;) {
    const std::size_t end = line.find('"', begin);
    if (end == line.npos) throw std::invalid_argument("a double quote is not closed");
    word += line.substr(begin, end - begin);
    begin = end + 1;
    if (begin == line.size() || line[begin] != '"') return word;
    word += line[begin++];
  }
}

std::vector<std::string> words(std::string_view line) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < line.size();) {
    if (std::isspace(static_cast<unsigned char>(line[i]))) {
      ++i;
    } else if (line[i] == '#') {
      break;
    } else if (line[i] == '"') {
      result.push_back(quoted_word(line, ++i));
    } else {
      const std::size_t end = std::min(line.find_first_of(" \t\r", i), line.size());
      result.emplace_back(line.substr(i, end - i));
      i = end;
    }
  }
  return result;
}

std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\r\v\f#\"") == text.npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

}  // namespace

double Arguments::number(std::size_t i) const {
  double value = 0;
  parse_number(texts_[i], value);
  return value;
}

std::string Shortcut::text() const {
  const auto code = static_cast<int>(key);
  const std::string name = key == Key::space    ? "Space"
                           : key == Key::escape ? "Esc"
                           : key >= Key::f1     ? fmt::format("F{}", code - static_cast<int>(Key::f1) + 1)
                                                : std::string(1, static_cast<char>(code));
  return control ? "Ctrl+" + name : name;
}

std::string Command::keys() const {
  std::string result;
  for (const Shortcut& shortcut : shortcuts)
    if (shortcut.arguments.empty()) result += (result.empty() ? "" : ", ") + shortcut.text();
  return result;
}

std::string Command::usage() const {
  std::string result = name;
  for (const Argument& a : arguments) result += a.optional ? " [" + upper_case(a.name) + "]" : " " + upper_case(a.name);
  return result;
}

std::span<const Command> commands() {
  static const std::vector<Command> all = [] {
    std::vector<Command> list;
    for (auto part : {file_commands(), scan_commands(), gibbs_commands(), selection_commands(), scene_commands(),
                      window_commands()})
      std::move(part.begin(), part.end(), std::back_inserter(list));
    return list;
  }();
  return all;
}

std::vector<std::string> menus() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    if (std::find(names.begin(), names.end(), command.menu) == names.end()) names.push_back(command.menu);
  return names;
}

const Command& find_command(std::string_view name) {
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  throw std::invalid_argument(
      fmt::format("there is no command '{}'; did you mean '{}'?", name, nearest(std::string(name), names)));
}

CommandCall make_call(std::string_view name, std::vector<std::string> arguments) {
  const Command& command = find_command(name);
  const auto& declared = command.arguments;
  if (arguments.size() > declared.size() ||
      (arguments.size() < declared.size() && !declared[arguments.size()].optional))
    throw std::invalid_argument(
        fmt::format("{} takes {}: {}", command.name, declared.empty() ? "no value" : "other values", command.usage()));
  for (std::size_t i = 0; i < arguments.size(); ++i) check(command, declared[i], arguments[i]);
  return {&command, std::move(arguments), 0};
}

std::string CommandCall::text() const {
  std::string result = command->name;
  for (const std::string& argument : arguments) result += " " + quoted(argument);
  return result;
}

CommandCall parse_call(std::string_view line) {
  std::vector<std::string> all = words(line);
  if (all.empty()) throw std::invalid_argument("no command");
  const std::string name = all.front();
  all.erase(all.begin());
  return make_call(name, std::move(all));
}

std::vector<CommandCall> parse_script(std::string_view text) {
  std::vector<CommandCall> calls;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    try {
      if (words(line).empty()) continue;
      calls.push_back(parse_call(line));
      calls.back().line = number;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("line {}: {}", number, error.what()));
    }
  }
  return calls;
}

void execute(const CommandCall& call, CommandTarget& target) {
  const Command& command = *call.command;
  if (command.why_not) {
    const std::string reason = command.why_not(target.state());
    if (!reason.empty()) throw std::invalid_argument(fmt::format("{}: {}", command.name, reason));
  }
  command.run(target, Arguments(call.arguments));
}

std::string command_table() {
  std::string table = "| command | key | does |\n|---|---|---|\n";
  for (const Command& command : commands()) {
    std::string keys;
    for (const Shortcut& s : command.shortcuts)
      keys += fmt::format("{}{}{}", keys.empty() ? "" : ", ", s.text(),
                          s.arguments.empty() ? "" : fmt::format(" ({})", fmt::join(s.arguments, " ")));
    table += fmt::format("| `{}` | {} | {} |\n", command.usage(), keys, command.help);
  }
  return table;
}

}  // namespace nextview
