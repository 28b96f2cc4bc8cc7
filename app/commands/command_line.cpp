#include "app/commands/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/config/configuration.hpp"
#include "core/config/known_objects.hpp"
#include "core/file/read_file.hpp"
#include "core/setting/mistyped_path.hpp"

namespace nextview {
namespace {

constexpr std::array subcommands = {"scan",  "score",  "refine", "posterior", "calibrate", "info",  "export",
                                    "study", "figure", "driver", "demo",      "help",      "window"};
constexpr std::array drawing = {"scan", "refine", "calibrate", "figure"};

template <class List>
bool has(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Behind the program's name and the options that every subcommand has.
std::size_t first_of_its_own(const std::vector<char*>& arguments) {
  std::size_t i = 1;
  while (i < arguments.size()) {
    const std::string_view word = arguments[i];
    if (word == "--threads")
      i += 2;
    else if (word.starts_with("--threads="))
      i += 1;
    else
      break;
  }
  return std::min(i, arguments.size());
}

bool is_object(const std::string& name) {
  try {
    return !resolve_object(name).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// What is there is opened, and of what looks like a file the window tells that it is not there.
void require_file_or_object(const std::string& word) {
  if (word.empty() || word.find_first_of("./") != word.npos || is_there(word) || is_object(word)) return;
  const auto objects = known_objects();
  std::vector<std::string> known(subcommands.begin(), subcommands.end());
  known.insert(known.end(), objects.begin(), objects.end());
  const std::string hint = did_you_mean_path(word, known, ";");
  throw std::runtime_error(
      fmt::format("no such command '{}', nor a file or an object of this name{} {} nextview --help", word, hint,
                  hint == ";" ? "see" : "See"));
}

bool gives(const std::vector<std::string_view>& words, std::string_view option) {
  return std::ranges::any_of(
      words, [&](std::string_view word) { return word == option || word.starts_with(std::string(option) + "="); });
}

/// Options may stand before what they are of, so any of the words may be the one.
bool exports_pixels(const std::vector<std::string_view>& words) {
  return has(words, "picture") || has(words, "turntable") ||
         std::ranges::any_of(words, [](std::string_view word) { return word.ends_with(".png"); });
}

}  // namespace

CommandLine command_line(std::vector<char*> arguments) {
  static char window[] = "window";
  const std::size_t first = first_of_its_own(arguments);
  const std::string word = first < arguments.size() ? arguments[first] : "";
  CommandLine line{std::move(arguments)};
  const auto begin = line.arguments.begin() + static_cast<std::ptrdiff_t>(first);
  if (has(subcommands, word)) {
    const std::vector<std::string_view> others(begin, line.arguments.end());
    const bool draws = word == "export" ? exports_pixels(others)
                       : word == "demo" ? gives(others, "--out") && !has(others, "--check")
                                        : has(drawing, word);
    line.draws_headless = draws && !has(others, "--no-pictures") && !has(others, "--list") && !has(others, "--help") &&
                          !has(others, "-h");
  } else if (word != "--help" && word != "-h" && word != "--version") {
    if (!word.starts_with('-')) require_file_or_object(word);
    line.arguments.insert(begin, window);
  }
  return line;
}

}  // namespace nextview
