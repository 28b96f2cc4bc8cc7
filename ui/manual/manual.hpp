#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

/// A page of the manual: assets/manual/TOPIC.md.
struct ManualPage {
  std::string topic;  ///< "planning"
  std::string title;  ///< "How the next view is chosen"
  std::string text;   ///< Markdown
};

/// Where the pages are: Markdown, to be read by any other program, too.
std::filesystem::path manual_folder();

/// All pages in the order of reading: as assets/manual/README.md links to them, which itself is none.
/// @throws std::runtime_error naming the file that cannot be read.
std::vector<std::string> manual_topics();

/// @throws std::runtime_error naming the nearest topic, or the file that cannot be read.
ManualPage read_manual_page(const std::string& topic);

}  // namespace nextview
