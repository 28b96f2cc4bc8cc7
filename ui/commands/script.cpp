#include "ui/commands/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "ui/commands/command_list.hpp"
#include "ui/commands/former_commands.hpp"

namespace nextview {
namespace {

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

}  // namespace

std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\r\v\f#\"") == text.npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

CommandCall parse_call(std::string_view line) {
  std::vector<std::string> values = words(line);
  if (values.empty()) throw std::invalid_argument("no command");
  const Command& command = find_command(current_command_name(values.front()));
  values.erase(values.begin());
  return command.read(std::move(values));
}

std::vector<CommandCall> parse_script(std::string_view text, std::string_view place) {
  std::vector<CommandCall> calls;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    try {
      if (line.find('\0') != line.npos) throw std::invalid_argument("holds a NUL: it is no text");
      if (words(line).empty()) continue;
      calls.push_back(parse_call(line));
      calls.back().line = number;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}{}: {}", place, number, error.what()));
    }
  }
  return calls;
}

}  // namespace nextview
