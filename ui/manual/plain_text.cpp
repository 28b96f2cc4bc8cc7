// Pages for a terminal.
#include <algorithm>
#include <numeric>

#include "ui/manual/markdown.hpp"

namespace nextview {
namespace {

using Block = MarkdownBlock;
using Kind = MarkdownBlock::Kind;

/// In columns: characters of UTF-8.
std::size_t columns(std::string_view text) {
  return std::size_t(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// In lines of at most so many columns, where words allow it; `first` stands before the first, `next` before the
/// others.
std::string wrapped(std::string_view text, std::size_t width, const std::string& first, const std::string& next) {
  std::string result, line = first;
  std::size_t words = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words > 0 && columns(line) + 1 + columns(word) > width) {
      result += line + '\n';
      line = next;
      words = 0;
    }
    if (words > 0) line += ' ';
    line += word;
    ++words;
  }
  return result + line + '\n';
}

/// Column under column if that fits; otherwise each row is its first cell, and beneath it the others with their heads.
std::string table_text(const Block& block, std::size_t width) {
  const auto& rows = block.rows;
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(row[i]));
  std::string result;
  const bool fits = std::accumulate(widths.begin(), widths.end(), 2 * widths.size()) <= width;
  for (std::size_t r = fits ? 0 : 1; r < rows.size(); ++r) {
    std::string line;
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      const std::string& cell = rows[r][i];
      if (fits)
        line += cell + std::string(i + 1 < widths.size() ? widths[i] - columns(cell) + 2 : 0, ' ');
      else if (i == 0)
        line += wrapped(cell, width, "", "  ");
      else if (!cell.empty())
        line += wrapped(cell, width, rows[0][i].empty() ? "    " : "    " + rows[0][i] + ": ", "    ");
    }
    line.erase(line.find_last_not_of(" \n") + 1);
    result += line + '\n';
    if (fits && r == 0) result += std::string(std::min(columns(line), width), '-') + '\n';
  }
  return result;
}

std::string indented(const std::string& lines) {
  std::string result;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    result += "    " + lines.substr(begin, end - begin) + '\n';
    begin = end + 1;
  }
  return result;
}

std::string text_of(const Block& block, std::size_t width) {
  switch (block.kind) {
    case Kind::heading:
      return block.text + '\n' + std::string(columns(block.text), block.level == 1 ? '=' : '-') + '\n';
    case Kind::item: {
      const std::string mark = (block.number.empty() ? "-" : block.number) + " ";
      return wrapped(block.text, width, mark, std::string(mark.size(), ' '));
    }
    case Kind::code:
      return indented(block.text);
    case Kind::table:
      return table_text(block, width);
    case Kind::picture:
      return wrapped("(picture: " + block.text + ")", width, "", "");
    case Kind::paragraph:
      break;
  }
  return wrapped(block.text, width, "", "");
}

}  // namespace

std::string plain_text(const std::vector<Block>& blocks, std::size_t width) {
  std::string result;
  Kind before = Kind::heading;
  for (const Block& block : blocks) {
    const bool list_goes_on = block.kind == Kind::item && before == Kind::item;
    if (!result.empty() && !list_goes_on) result += '\n';
    result += text_of(block, width);
    before = block.kind;
  }
  return result;
}

}  // namespace nextview
