#include "ui/manual/manual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

#include "core/config/configuration.hpp"
#include "core/file/installation.hpp"
#include "core/file/read_file.hpp"
#include "core/setting/setting.hpp"

namespace nextview {
namespace {

constexpr std::uintmax_t longest_page = std::uintmax_t{1} << 20;  // [bytes]

/// What stands behind the first "# ".
std::string title_of(const std::string& text) {
  const std::size_t begin = text.starts_with("# ") ? 2 : 0;
  return text.substr(begin, text.find('\n') - begin);
}

}  // namespace

/// Assets of one's own need not bring a manual.
std::filesystem::path manual_folder() {
  const std::filesystem::path named = assets_folder() / "manual";
  return is_there(named) ? named : shared_folder("assets") / "manual";
}

std::vector<std::string> manual_topics() {
  const std::string contents = read_file(manual_folder() / "README.md", longest_page);
  static const std::regex link(R"(\]\(([a-z_]+)\.md\))");
  std::vector<std::string> topics;
  for (std::sregex_iterator found(contents.begin(), contents.end(), link), end; found != end; ++found)
    if (std::ranges::find(topics, (*found)[1].str()) == topics.end()) topics.push_back((*found)[1]);
  return topics;
}

ManualPage read_manual_page(const std::string& topic) {
  const auto topics = manual_topics();
  if (std::ranges::find(topics, topic) == topics.end())
    throw std::runtime_error(fmt::format("there is no topic '{}' in the manual{}", topic, did_you_mean(topic, topics)));
  const std::string text = read_file(manual_folder() / (topic + ".md"), longest_page);
  return {topic, title_of(text), text};
}

}  // namespace nextview
