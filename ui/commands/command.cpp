#include "ui/commands/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

#include "ui/commands/script.hpp"

namespace nextview {

bool Shortcut::is_with(bool control_held, bool shift_held) const {
  const bool shift_counts = control && std::isalpha(static_cast<int>(key));
  return control == control_held && (!shift_counts || shift == shift_held);
}

std::string Shortcut::text() const {
  const auto code = static_cast<int>(key);
  const std::string name = key == Key::space       ? "Space"
                           : key == Key::escape    ? "Esc"
                           : key == Key::page_up   ? "Page Up"
                           : key == Key::page_down ? "Page Down"
                           : key == Key::left      ? "Left"
                           : key == Key::right     ? "Right"
                           : key == Key::up        ? "Up"
                           : key == Key::down      ? "Down"
                           : key >= Key::f1        ? fmt::format("F{}", code - static_cast<int>(Key::f1) + 1)
                                                   : std::string(1, static_cast<char>(code));
  return (control ? "Ctrl+" : "") + std::string(shift ? "Shift+" : "") + name;
}

std::string CommandCall::text() const {
  std::string result = command->name;
  for (const std::string& value : values()) result += fmt::format(" {}", quoted(value));
  return result;
}

Command::Command(CommandDeclaration declaration, std::vector<Argument> arguments)
    : CommandDeclaration(std::move(declaration)), arguments_(std::move(arguments)) {
  for (Argument& argument : arguments_) argument.command = name;
}

std::string Command::why_not_now(const CommandState& state) const {
  constexpr std::array of_the_session = {"File", "Scan", "Timeline", "Gibbs"};
  constexpr std::array answers = {"answer", "cancel", "quit"};
  const bool waits =
      !state.progress.question.empty() && std::ranges::find(of_the_session, menu) != of_the_session.end();
  if (waits && std::ranges::find(answers, name) == answers.end()) return "answer the question first";
  return why_not ? why_not(state) : "";
}

std::string Command::keys() const {
  std::string result;
  for (const Shortcut& shortcut : shortcuts())
    if (shortcut.values.empty()) result += (result.empty() ? "" : ", ") + shortcut.text();
  return result;
}

std::string Command::usage() const {
  std::string result = name;
  for (const Argument& argument : arguments_) {
    std::string word = argument.name;
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
    result += argument.optional ? " [" + word + "]" : " " + word;
  }
  return result;
}

CommandCall Command::read(std::vector<std::string> values) const {
  if (respell) values = respell(std::move(values));
  const bool begins_with_words = !arguments_.empty() && (arguments_.front().kind == Argument::Kind::text ||
                                                         arguments_.front().kind == Argument::Kind::file);
  const char* const hint = begins_with_words && values.size() > 1 ? "; what has blanks stands in double quotes" : "";
  if (values.size() > arguments_.size() || (values.size() < arguments_.size() && !arguments_[values.size()].optional))
    throw std::invalid_argument(
        fmt::format("{} takes {}: {}{}", name, arguments_.empty() ? "no value" : "other values", usage(), hint));
  try {
    return read_values(std::move(values));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(error.what() + std::string(hint));
  }
}

}  // namespace nextview
