// The manual in a terminal, and its examples run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "core/file/atomic_file.hpp"
#include "tests/integration/manual_pages.hpp"
#include "tests/integration/program.hpp"
#include "ui/manual/manual.hpp"
#include "ui/manual/markdown.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Manual, CheapExamplesRun) {
  int run = 0;
  for (const auto& file : manual_pages()) {
    const TemporaryFolder folder;
    for (const std::string& line : shell_lines(file, true)) {
      const Result result = nextview_behind(fmt::format("env -C '{}'", folder.path().string()),
                                            line.substr(std::min(line.find(' ') + 1, line.size())));
      EXPECT_EQ(result.exit_code, 0) << file.filename() << ": " << line << "\n" << result.err;
      EXPECT_FALSE(result.out.empty()) << line;
      ++run;
    }
  }
  EXPECT_GE(run, 3) << "what is to be run is no longer found";
}

/// `surface_map.*` stands for all that begin so, `step_01.png` for the pictures of all steps.
bool is_named(const std::string& file, const std::string& page) {
  if (page.find('`' + file + '`') != page.npos || file.starts_with("step_")) return true;
  const std::string begin = file.substr(0, file.find_first_of("._", file.find('_') + 1));
  return page.find('`' + begin + ".*`") != page.npos;
}

TEST(Manual, EveryFileThatAScanLeavesIsAmongTheFormats) {
  const TemporaryFolder folder;
  const Result scan = nextview(fmt::format(
      "scan sphere --views 2 --sensor.width 80 --sensor.height 60 --map.resolution 0.04 --no-pictures --out '{}'",
      (folder.path() / "out").string()));
  ASSERT_EQ(scan.exit_code, 0) << scan.err;
  const std::string page = read_manual_page("formats").text;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out")) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(entry.is_directory() ? page.find('`' + name + "/`") != page.npos : is_named(name, page)) << name;
  }
  EXPECT_FALSE(is_named("other.csv", page));
}

TEST(Manual, ExamplesOfSettingsAreRead) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "example.toml";
  int read = 0;
  for (const auto& page : manual_pages())
    for (const MarkdownBlock& block : parse_markdown(read_file(page))) {
      if (block.language != "toml") continue;
      write_file(file, block.text);
      const Result result = nextview("info '" + file.string() + "'");
      EXPECT_EQ(result.exit_code, 0) << page << ": " << result.err;
      ++read;
    }
  EXPECT_GT(read, 0);
}

TEST(Manual, IsPrintedByTopicAndKnowsTheNearest) {
  const Result topics = nextview("help");
  EXPECT_EQ(topics.exit_code, 0) << topics.err;
  for (const std::string& topic : manual_topics()) {
    EXPECT_THAT(topics.out, HasSubstr("  " + topic + " "));
    auto blocks = parse_markdown(read_manual_page(topic).text);
    EXPECT_FALSE(plain_text(blocks, 100).empty());
    std::erase_if(blocks, [](const MarkdownBlock& block) { return block.kind == MarkdownBlock::Kind::code; });
    const std::string text = plain_text(blocks, 100);
    EXPECT_EQ(text.find("]("), text.npos) << topic << " has a link left";
    EXPECT_EQ(text.find("**"), text.npos) << topic << " has emphasis left";
  }
  EXPECT_THAT(nextview("help planning").out, HasSubstr("How the next view is chosen\n==="));
  EXPECT_THAT(nextview("help scan").out, AllOf(HasSubstr("nextview scan [OPTIONS]"), HasSubstr("--resume")));
  EXPECT_THAT(nextview("help take-view").out, AllOf(HasSubstr("take-view [CANDIDATE]"), HasSubstr("help commands")));
  const Result wrong = nextview("help planing");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("there is no topic 'planing'; did you mean 'planning'?"));
}

TEST(Manual, SaysWhatASettingIs) {
  const Result one = nextview("help planner.cost_weight"), group = nextview("help planner");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("weight of the distance in the utility"));
  EXPECT_THAT(one.out, Not(HasSubstr("ray_columns")));
  EXPECT_THAT(one.out, HasSubstr("0.3")) << "its default";
  EXPECT_THAT(nextview("help options").out, HasSubstr("replaced (default refined)")) << "where refine writes of itself";
  EXPECT_THAT(group.out, AllOf(HasSubstr("planner.cost_weight"), HasSubstr("planner.ray_columns")));
  EXPECT_THAT(group.out, Not(HasSubstr("map.hit")));
  EXPECT_THAT(nextview("help map.region").out, HasSubstr("numbers [m]"));
  EXPECT_THAT(nextview("help seed").out, HasSubstr("seed of everything random"));
  const Result wrong = nextview("help planner.cost");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'planner.cost_weight'?"));
  EXPECT_THAT(nextview("help sensr").err, HasSubstr("did you mean 'sensor'?"));
}

TEST(Manual, TheShellIsToldWhatAnOptionTakes) {
  const Result completion = nextview("help --completion");
  EXPECT_EQ(completion.exit_code, 0) << completion.err;
  for (const char* line :
       {"    --driver-confirm) words='always never' ;;\n", "    --of) words='map cloud' ;;\n",
        "    --fit) words='sensor-model new-surface' ;;\n", "    --gibbs.sampler) words='exact algorithm1' ;;\n"})
    EXPECT_THAT(completion.out, HasSubstr(line));
}

TEST(Manual, TheShellCompletesWhatACommandTakes) {
  const TemporaryFolder folder;  // whatever lies in the folder where the tests run
  write_file(folder.path() / "planning_notes", "");
  const auto completed = [&](const std::string& words, int at) {
    return nextview_behind(
               fmt::format("bash -c 'cd {}; source <(\"$0\" help --completion); COMP_WORDS=({}); COMP_CWORD={}; "
                           "_nextview; echo \"${{COMPREPLY[@]}}\"'",
                           folder.path().string(), words, at),
               "")
        .out;
  };
  EXPECT_EQ(completed("nextview fig", 1), "figure\n");
  EXPECT_EQ(completed("nextview figure rep", 2), "report\n");
  EXPECT_EQ(completed("nextview demo to", 2), "tour\n");
  EXPECT_EQ(completed("nextview scan gear", 2), "gearbox\n");
  EXPECT_EQ(completed("nextview help planni", 2), "planning\n") << "which takes no file";
  EXPECT_EQ(completed("nextview refine plann", 2), "planning_notes\n");
  EXPECT_EQ(completed("nextview help planner.cost", 2), "planner.cost_weight\n");
  EXPECT_EQ(completed("nextview study smo", 2), "smoke\n");
  EXPECT_EQ(completed("nextview export out clo", 3), "cloud\n");
  EXPECT_EQ(completed("nextview posterior --problem corr", 3), "corridor\n");
  EXPECT_EQ(completed("nextview scan --sensor narr", 3), "narrow\n");
  EXPECT_EQ(completed("nextview scan --config calib", 3), "calibrated\n");
  EXPECT_EQ(completed("nextview export out picture a.png --layers obj", 6), "object\n");
  EXPECT_EQ(completed("nextview scan --resu", 2), "--resume\n");
  EXPECT_EQ(completed("nextview scan gearbox --gibbs.sampler alg", 4), "algorithm1\n");
}

TEST(Manual, TheShellCompletesSessionsThatAreKept) {
  const TemporaryFolder folder;
  const fs::path state = folder.path() / "state", kept = state / "nextview/2026-01-31 23.59.59 gearbox";
  fs::create_directories(kept);
  fs::create_directories(state / "nextview/2026-01-31 23.59.59 gear without views");
  fs::create_directories(folder.path() / "my part");
  write_file(kept / "journal", "");
  const auto completed = [&](const std::string& words, int at) {
    return nextview_behind(
               fmt::format("env XDG_STATE_HOME={} bash -c 'cd {}; source <(\"$0\" help --completion); COMP_WORDS=({}); "
                           "COMP_CWORD={}; _nextview; printf \"<%s>\" \"${{COMPREPLY[@]}}\"'",
                           state.string(), folder.path().string(), words, at),
               "")
        .out;
  };
  const std::string session = "<" + kept.string() + ">";
  EXPECT_EQ(completed("nextview export gear", 2), session);
  EXPECT_EQ(completed("nextview scan --resume gear", 3), session);
  EXPECT_EQ(completed("nextview score " + state.string() + "/", 2),
            "<" + (state / "nextview").string() + ">" + session);
  EXPECT_EQ(completed("nextview refine \\\"my", 2), "<my part>") << "in a quote that is still open";
  EXPECT_EQ(completed("nextview study gear", 2), "<>") << "which takes none";
}

TEST(Manual, AnOptionThatWouldDoNothingIsRefused) {
  const Result result = nextview("demo tour --fps 4");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--size, --fps and --video need --out DIR"));
}

}  // namespace
}  // namespace nextview
