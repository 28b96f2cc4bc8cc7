#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// A line of a text that holds numbers, maybe behind words.
struct NumberLine {
  std::size_t line = 0;         ///< from 1
  std::string words;            ///< what is no number, in front; of a comment or a heading, all of it
  std::vector<double> numbers;  ///< none of blank lines and headings
  bool is_blank() const { return words.empty() && numbers.empty(); }
};

/// Takes a text apart. A line that begins with #, or goes on with words behind its numbers, is words alone.
std::vector<NumberLine> number_lines(std::string_view text);

/// A block of lines with equally many numbers each, with what the last line of words above it said.
struct NumberBlock {
  std::string heading;
  std::vector<NumberLine> rows;
  std::size_t columns() const { return rows.front().numbers.size(); }
};
std::vector<NumberBlock> number_blocks(std::string_view text);

/// The text of a small file, plain or compressed (.gz). @throws std::runtime_error naming it
std::string read_text(const std::filesystem::path& file);

/// "FILE:LINE: reason"
std::runtime_error line_failure(const std::filesystem::path& file, std::size_t line, const std::string& reason);

}  // namespace nextview
