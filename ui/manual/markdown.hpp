#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// A part of a page in Markdown, as far as the manual uses it. Emphasis and links are left out of texts, comments of
/// the whole; a link is what it says.
struct MarkdownBlock {
  enum class Kind { heading, paragraph, item, code, table, picture };
  Kind kind = Kind::paragraph;
  std::string text = {};                            ///< of code: its lines; of a picture: what it shows
  int level = 0;                                    ///< of a heading, from 1
  std::string number = {};                          ///< of an item in a numbered list: "1."; empty otherwise
  std::vector<std::vector<std::string>> rows = {};  ///< of a table; the first are its heads, all of one length
  std::string language = {};                        ///< of code, as behind its fence: "sh"
};

std::vector<MarkdownBlock> parse_markdown(std::string_view text);

/// For a terminal of so many columns.
std::string plain_text(const std::vector<MarkdownBlock>& blocks, std::size_t width);

}  // namespace nextview
