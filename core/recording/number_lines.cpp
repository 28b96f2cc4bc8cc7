#include "core/recording/number_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/file/gzip_file.hpp"

namespace nextview {
namespace {

constexpr std::string_view blanks = " \t\r,;";
constexpr std::uintmax_t largest_text = 1u << 26;

/// "nan" and "inf" are numbers, which who uses them refuses.
std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

NumberLine number_line(std::string_view text) {
  NumberLine line;
  while (!text.empty() && blanks.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  std::string_view rest = text;
  while (!rest.empty() && text.front() != '#') {
    const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
    const std::optional<double> value = number(word);
    if (!value && !line.numbers.empty()) break;
    if (value)
      line.numbers.push_back(*value);
    else
      line.words += fmt::format("{}{}", line.words.empty() ? "" : " ", word);
    rest.remove_prefix(word.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  }
  if (!rest.empty()) return {0, std::string(text), {}};  // a comment, or words behind numbers
  return line;
}

}  // namespace

std::vector<NumberLine> number_lines(std::string_view text) {
  std::vector<NumberLine> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(number_line(text.substr(0, end)));
    lines.back().line = lines.size();
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<NumberBlock> number_blocks(std::string_view text) {
  std::vector<NumberBlock> blocks;
  std::string heading;
  bool goes_on = false;
  for (NumberLine& line : number_lines(text)) {
    if (line.numbers.empty()) {
      if (!line.is_blank()) heading = line.words;
      goes_on = false;
      continue;
    }
    if (!line.words.empty()) {
      heading = line.words;
      goes_on = false;
    }
    if (!goes_on || blocks.back().columns() != line.numbers.size()) blocks.push_back({heading, {}});
    if (!goes_on) heading.clear();
    goes_on = true;
    blocks.back().rows.push_back(std::move(line));
  }
  return blocks;
}

std::string read_text(const std::filesystem::path& file) { return read_plain_or_gzip(file, largest_text); }

std::runtime_error line_failure(const std::filesystem::path& file, std::size_t line, const std::string& reason) {
  return std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, reason));
}

}  // namespace nextview
