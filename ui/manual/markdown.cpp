#include "ui/manual/markdown.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <utility>

namespace nextview {
namespace {

using Block = MarkdownBlock;
using Kind = MarkdownBlock::Kind;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

constexpr char link_begins = 1, link_ends = 2;  // which no text has

/// Of links what they say, between marks; of pictures, too, but without.
std::string with_marked_links(const std::string& text, std::vector<std::string>& targets) {
  static const std::regex link(R"((!?)\[([^\]]*)\]\(([^)]*)\))");
  std::string result;
  auto rest = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; rest = (*at++)[0].second) {
    const std::string says = (*at)[2];
    const bool is_picture = (*at)[1].length() > 0;
    result.append(rest, (*at)[0].first).append(is_picture ? says : link_begins + says + link_ends);
    if (!is_picture) targets.push_back((*at)[3]);
  }
  return result.append(rest, text.end());
}

/// Takes the marks out of a text.
std::vector<MarkdownLink> take_links(std::string& text, const std::vector<std::string>& targets) {
  std::vector<MarkdownLink> links;
  std::string plain;
  for (const char c : text)
    if (c == link_begins)
      links.push_back({plain.size(), plain.size(), targets[links.size()]});
    else if (c == link_ends)
      links.back().end = plain.size();
    else
      plain += c;
  text = std::move(plain);
  return links;
}

/// Without emphasis, and of links what they say. What stands in backquotes stays as it is.
std::string unmarked(std::string_view marked, std::vector<MarkdownLink>* links = nullptr) {
  static const std::regex bold(R"(\*\*([^*]+)\*\*)"), italic(R"((^|[^A-Za-z0-9*])\*([^* ][^*]*)\*)");
  std::vector<std::string> targets;
  std::string result;
  for (bool code = false; !marked.empty(); code = !code) {
    const std::size_t end = std::min(marked.find('`'), marked.size());
    std::string part(marked.substr(0, end));
    if (!code) {
      part = with_marked_links(part, targets);
      part = std::regex_replace(part, bold, "$1");
      part = std::regex_replace(part, italic, "$1$2");
    }
    result += part;
    marked.remove_prefix(std::min(end + 1, marked.size()));
  }
  std::vector<MarkdownLink> found = take_links(result, targets);
  if (links) *links = std::move(found);
  return result;
}

/// The cells of "| a | b |"; "\|" is a bar within one.
std::vector<std::string> cells(std::string_view line, std::size_t row, std::vector<MarkdownLink>& links) {
  line = trimmed(line);
  if (line.starts_with('|')) line.remove_prefix(1);
  if (line.ends_with('|')) line.remove_suffix(1);
  std::vector<std::string> result;
  std::string cell;
  const auto end_cell = [&] {
    std::vector<MarkdownLink> found;
    result.push_back(unmarked(trimmed(std::exchange(cell, {})), &found));
    for (const MarkdownLink& link : found) links.push_back({link.begin, link.end, link.target, row, result.size() - 1});
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escaped = line.substr(i).starts_with("\\|");
    if (line[i] == '|')
      end_cell();
    else
      cell += escaped ? line[++i] : line[i];
  }
  end_cell();
  return result;
}

bool is_rule(std::string_view line) { return !line.empty() && line.find_first_not_of("|-: ") == line.npos; }

/// "- " or "12. ": how long it is; 0: the line begins no item.
std::size_t item_mark(std::string_view line) {
  if (line.starts_with("- ")) return 2;
  const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
  return digits > 0 && line.substr(digits).starts_with(". ") ? digits + 2 : 0;
}

/// Line by line; what belongs together is gathered until something else begins.
class Reader {
 public:
  std::vector<Block> read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    finish();
    return std::move(blocks_);
  }

 private:
  void take(std::string_view raw) {
    const std::string_view line = trimmed(raw);
    if (in_code_) return take_code(raw, line);
    if (in_comment_ || line.starts_with("<!--")) {
      in_comment_ = line.find("-->") == line.npos;
      return finish();
    }
    if (line.empty() || line == "<br>") return finish();
    if (line.starts_with("```")) {
      finish();
      in_code_ = true;
      blocks_.push_back({.kind = Kind::code, .language = std::string(line.substr(3))});
    } else if (line.starts_with('#')) {
      take_heading(line);
    } else if (line.starts_with('|') && line.find("![") != line.npos) {
      take_pictures(line);
    } else if (line.starts_with('|')) {
      take_row(line);
    } else if (line.starts_with("![")) {
      finish();
      const std::size_t file = line.find("](") + 2;
      blocks_.push_back({.kind = Kind::picture,
                         .text = unmarked(line),
                         .picture = std::string(line.substr(file, line.find(')', file) - file))});
    } else {
      take_text(line);
    }
  }

  void take_code(std::string_view raw, std::string_view line) {
    if (line.starts_with("```"))
      in_code_ = false;
    else
      blocks_.back().text += std::string(raw) + '\n';
  }

  void take_heading(std::string_view line) {
    finish();
    const std::size_t level = line.find_first_not_of('#');
    if (level == line.npos) return;
    blocks_.push_back({.kind = Kind::heading, .text = unmarked(trimmed(line.substr(level))), .level = int(level)});
  }

  void take_row(std::string_view line) {
    if (open_.kind != Kind::table) finish();
    open_.kind = Kind::table;
    if (is_rule(line)) return;
    open_.rows.push_back(cells(line, open_.rows.size(), open_.links));
    open_.rows.back().resize(open_.rows.front().size());
  }

  /// A table of pictures, whose heads are empty: what each is called and shows.
  void take_pictures(std::string_view line) {
    if (open_.kind == Kind::table) open_ = {};
    finish();
    static const std::regex picture(R"(!\[([^\]]*)\]\(([^)]*)\)([^|]*))");
    const std::string row(line);
    for (auto at = std::sregex_iterator(row.begin(), row.end(), picture); at != std::sregex_iterator(); ++at) {
      const std::string shows = (*at)[1], caption = (*at)[3], name = unmarked(trimmed(caption));
      const char* const between = shows.empty() || name.empty() ? "" : ": ";
      blocks_.push_back({.kind = Kind::item, .text = name + between + shows, .picture = (*at)[2]});
    }
  }

  void take_text(std::string_view line) {
    const std::size_t mark = item_mark(line);
    if (mark > 0 || open_.kind == Kind::table) finish();
    if (mark > 0) open_.kind = Kind::item;
    if (mark > 2 || (mark == 2 && line.front() != '-')) open_.number = std::string(line.substr(0, mark - 1));
    open_.text += (open_.text.empty() ? "" : " ") + std::string(line.substr(mark));
  }

  void finish() {
    if (open_.kind != Kind::table) open_.text = unmarked(open_.text, &open_.links);
    if (!open_.text.empty() || !open_.rows.empty()) blocks_.push_back(std::move(open_));
    open_ = {};
  }

  std::vector<Block> blocks_;
  Block open_;
  bool in_code_ = false, in_comment_ = false;
};

}  // namespace

std::vector<Block> parse_markdown(std::string_view text) { return Reader().read(text); }

}  // namespace nextview
