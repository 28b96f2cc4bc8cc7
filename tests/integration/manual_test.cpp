// README and manual: what they show can be done, what they say of declarations is so, and their links lead somewhere.
#include "ui/manual/manual.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>
#include <utility>

#include "app/all_commands.hpp"
#include "app/commands/manual_tables.hpp"
#include "core/driver/words.hpp"
#include "core/file/read_file.hpp"
#include "core/recording/dataset.hpp"
#include "tests/integration/manual_pages.hpp"
#include "ui/commands/script.hpp"
#include "ui/manual/markdown.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Kind = MarkdownBlock::Kind;

const fs::path source = NEXTVIEW_SOURCE_DIR;

/// What `nextview` is given by an example; none if it is of another program, or through one.
std::optional<std::vector<std::string>> arguments_of(const std::string& line) {
  std::vector<std::string> words = shell_words(line);
  static const std::set<std::string> names = {"nextview", "app/run", "build/release/nextview"};
  if (words.empty() || !names.contains(words.front())) return std::nullopt;
  words.erase(words.begin());
  return words;
}

struct IsParsed {};
/// A command's function, which is not to be called, and holds what its options are read into.
struct Opened : CLI::App {
  using CLI::App::final_callback_;
};

/// Why a command line is not one that the program takes; empty: it is. Nothing is done.
std::string parse_error(std::vector<std::string> words) {
  CLI::App program;
  add_commands(program);
  program.add_option("--threads");
  std::set<std::string> names;
  std::vector<std::function<void()>> held;
  for (CLI::App* command : program.get_subcommands({})) {
    names.insert(command->get_name());
    auto& run = command->*(&Opened::final_callback_);
    held.push_back(std::exchange(run, [] { throw IsParsed(); }));
  }
  if (words.empty() || !names.contains(words.front())) words.insert(words.begin(), "window");
  std::ranges::reverse(words);  // as CLI11 wants them
  try {
    program.parse(words);
  } catch (const IsParsed&) {
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no command ran";
}

TEST(Manual, TablesAreThoseOfTheDeclarations) {
  announce_panels(standard_panels());
  CLI::App program;
  add_commands(program);
  for (const std::string& topic : manual_topics()) {
    const std::string text = read_file(source / "assets/manual" / (topic + ".md"));
    EXPECT_TRUE(text == with_tables(text, program))
        << topic << ".md is old: run build/release/nextview help --write assets/manual";
  }
}

TEST(Manual, EveryExampleIsACommandLineOfTheProgram) {
  announce_panels(standard_panels());
  int parsed = 0;
  for (const fs::path& file : manual_pages())
    for (const std::string& line : shell_lines(file, false))
      if (const auto arguments = arguments_of(line)) {
        EXPECT_EQ(parse_error(*arguments), "") << file.filename() << ": " << line;
        ++parsed;
      }
  EXPECT_GT(parsed, 60);
  EXPECT_NE(parse_error({"scan", "--no-such-option"}), "");
}

TEST(Manual, ExamplesOfScriptsAndCodeAreRight) {
  announce_panels(standard_panels());
  std::set<std::string> built;  // with an installation, by tests/install
  for (const char* file : {"CMakeLists.txt", "gain.cpp", "map.cpp", "parts.cpp"})
    built.insert(read_file(source / "tests/install/consumer" / file));
  std::set<std::string> languages;
  for (const fs::path& file : manual_pages())
    for (const MarkdownBlock& block : parse_markdown(read_file(file))) {
      if (block.kind != Kind::code) continue;
      SCOPED_TRACE(fmt::format("{}:\n{}", file.filename().string(), block.text));
      languages.insert(block.language);
      if (block.language == "nextview") {
        EXPECT_NO_THROW(parse_script(block.text));
      }
      if (block.language == "cpp" || block.language == "cmake") {
        EXPECT_TRUE(built.contains(block.text)) << "it is to be a file of tests/install/consumer";
      }
    }
  for (const char* shown : {"sh", "sh run", "nextview", "cpp", "cmake", "toml"})
    EXPECT_TRUE(languages.contains(shown)) << shown;
}

/// "Going back, and branches" as a link has it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading)
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || (c & 0x80))
      anchor += char(std::tolower(static_cast<unsigned char>(c)));
  return anchor;
}

bool has_anchor(const fs::path& file, const std::string& anchor) {
  for (const MarkdownBlock& block : parse_markdown(read_file(file)))
    if (block.kind == Kind::heading && anchor_of(block.text) == anchor) return true;
  return anchor.empty();
}

std::vector<std::string> links_of(const fs::path& file) {
  static const std::regex link(R"(\]\(([^)]+)\))");
  const std::string text = read_file(file);
  std::vector<std::string> links;
  for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found)
    links.push_back((*found)[1]);
  return links;
}

TEST(Manual, HasEveryKeyOfADataset) {
  const std::string page = read_manual_page("formats").text;
  DatasetDescription description;
  for (const Setting& setting : settings(description))
    EXPECT_NE(page.find("`" + setting.key + "`"), std::string::npos) << setting.key;
}

TEST(Manual, EveryLinkLeadsSomewhere) {
  int followed = 0;
  for (const fs::path& file : manual_pages())
    for (const std::string& link : links_of(file)) {
      if (link.starts_with("https://")) continue;
      const std::size_t hash = std::min(link.find('#'), link.size());
      const fs::path target = hash == 0 ? file : file.parent_path() / link.substr(0, hash);
      ASSERT_TRUE(fs::exists(target)) << file.filename() << " links to " << link;
      EXPECT_TRUE(hash == link.size() || has_anchor(target, link.substr(hash + 1))) << file.filename() << ": " << link;
      ++followed;
    }
  EXPECT_GT(followed, 100);
}

TEST(Manual, EveryPageIsATopicWithATitle) {
  const auto topics = manual_topics();
  for (const auto& entry : fs::directory_iterator(source / "assets/manual"))
    EXPECT_THAT(topics, ::testing::Contains(entry.path().stem()).Times(entry.path().stem() == "README" ? 0 : 1))
        << "assets/manual/README.md does not name it";
  for (const std::string& topic : topics) EXPECT_GT(read_manual_page(topic).title.size(), 4u) << topic;
}

/// What tests compare with a stored picture, and what they make its name of.
std::set<std::string> words_of_tests() {
  static const std::regex word(R"re(RENDER_TEST(?:_WITHIN)?\((?:\{[^}]*\}, )?(\w+)|"([a-z][a-z0-9_]*)")re");
  std::set<std::string> words;
  for (const char* folder : {"tests", "ui/report"})
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = read_file(entry.path());
      for (std::sregex_iterator found(text.begin(), text.end(), word), end; found != end; ++found)
        words.insert((*found)[1].matched ? (*found)[1] : (*found)[2]);
    }
  return words;
}

TEST(Manual, EveryPictureIsMadeByATestAndShownSomewhere) {
  std::set<std::string> shown;
  for (const fs::path& file : manual_pages())
    for (const std::string& link : links_of(file)) shown.insert(fs::path(link).filename());
  const std::set<std::string> words = words_of_tests();
  for (const auto& entry : fs::directory_iterator(source / "screenshots")) {
    EXPECT_TRUE(shown.contains(entry.path().filename())) << entry.path().filename() << " is shown nowhere";
    std::string name = entry.path().stem();
    if (name.ends_with("_dark")) name.resize(name.size() - 5);
    const bool is_listed =
        (name.starts_with("study_") || name.starts_with("figure_")) && words.contains(name.substr(name.find('_') + 1));
    EXPECT_TRUE(words.contains(name) || is_listed) << name << ".png is made by no test";
  }
}

}  // namespace
}  // namespace nextview
