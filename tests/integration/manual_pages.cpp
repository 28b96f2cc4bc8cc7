#include "tests/integration/manual_pages.hpp"

#include <algorithm>
#include <sstream>

#include "core/file/read_file.hpp"
#include "ui/manual/markdown.hpp"

namespace nextview {

std::vector<std::filesystem::path> manual_pages() {
  const std::filesystem::path source = NEXTVIEW_SOURCE_DIR;
  std::vector<std::filesystem::path> files = {source / "README.md", source / "CHANGELOG.md"};
  for (const auto& entry : std::filesystem::directory_iterator(source / "assets/manual")) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> shell_lines(const std::filesystem::path& page, bool to_be_run) {
  std::vector<std::string> lines;
  for (const MarkdownBlock& block : parse_markdown(read_file(page))) {
    const bool is_shell = block.language == "sh run" || (!to_be_run && block.language == "sh");
    if (block.kind != MarkdownBlock::Kind::code || !is_shell) continue;
    std::istringstream text(block.text);
    for (std::string line; std::getline(text, line);) lines.push_back(line.substr(0, line.find(" #")));
  }
  return lines;
}

}  // namespace nextview
