#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// Where a text links to something.
struct MarkdownLink {
  std::size_t begin, end;           ///< of what it says, in the text
  std::string target;               ///< "gibbs.md#sweeps"
  std::size_t row = 0, column = 0;  ///< of the cell, in a table
};

/// A part of a page in Markdown, as far as the manual uses it. Emphasis and links are left out of texts, comments of
/// the whole; a link is what it says.
struct MarkdownBlock {
  enum class Kind { heading, paragraph, item, code, table, picture };
  Kind kind = Kind::paragraph;
  std::string text = {};                            ///< of code: its lines; of a picture: what it shows
  int level = 0;                                    ///< of a heading, from 1
  std::string number = {};                          ///< of an item in a numbered list: "1."; empty otherwise
  std::vector<std::vector<std::string>> rows = {};  ///< of a table; the first are its heads, all of one length
  std::vector<MarkdownLink> links = {};             ///< in the order of the text
  std::string picture = {};                         ///< its file, from the page's folder; empty: it is none
  std::string language = {};                        ///< of code, as behind its fence: "sh"
};

std::vector<MarkdownBlock> parse_markdown(std::string_view text);

/// For a terminal of so many columns.
std::string plain_text(const std::vector<MarkdownBlock>& blocks, std::size_t width);

}  // namespace nextview
