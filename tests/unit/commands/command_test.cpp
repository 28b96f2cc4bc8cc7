#include "ui/commands/command.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/unit/mesh/temporary_folder.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/scanner_commands.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// What an error says, which must be one line.
template <class Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

CommandCall make_call(const std::string& name, std::vector<std::string> values = {}) {
  return find_command(name).read(std::move(values));
}

CommandState state_of(const SessionSnapshot& session, const WorkerProgress& progress, const WindowState& window) {
  return {session, progress, window};
}

TEST(Commands, EachIsDeclaredWhole) {
  std::set<std::string> names, texts;
  EXPECT_GT(commands().size(), 40u);
  for (const Command& c : commands()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name << " is there twice";
    EXPECT_TRUE(texts.insert(c.menu + "/" + c.text).second) << c.text << " is twice in the menu " << c.menu;
    EXPECT_FALSE(c.name.empty());
    EXPECT_EQ(c.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << c.name;
    EXPECT_FALSE(c.menu.empty()) << c.name;
    EXPECT_FALSE(c.text.empty()) << c.name;
    EXPECT_THAT(c.help, testing::EndsWith(".")) << c.name << ": its help is not a sentence";
    EXPECT_EQ(c.help.find('|'), std::string::npos) << c.name << " would break the manual's table";
    EXPECT_EQ(&find_command(c.name), &c);
  }
}

TEST(Commands, ArgumentsAreNamedAndOptionalOnesComeLast) {
  for (const Command& c : commands()) {
    bool optional = false;
    for (const Argument& a : c.arguments()) {
      EXPECT_FALSE(a.name.empty()) << c.name;
      EXPECT_FALSE(a.help.empty()) << c.name << " " << a.name;
      EXPECT_TRUE(a.optional || !optional) << c.name << ": " << a.name << " after an optional one";
      optional = a.optional;
      if (a.kind == Argument::Kind::choice) {
        ASSERT_TRUE(a.choices) << c.name;
        EXPECT_FALSE(a.choices({}).empty()) << c.name;
      }
      if (a.kind == Argument::Kind::number || a.kind == Argument::Kind::whole) {
        EXPECT_LT(a.low, a.high) << c.name;
      }
    }
  }
}

TEST(Commands, TextEndsInDotsIfValuesAreAskedFor) {
  for (const Command& c : commands()) {
    const bool asks = !c.arguments().empty() && !c.arguments().front().optional;
    if (asks) {
      EXPECT_THAT(c.text, testing::EndsWith("…")) << c.name;
    }
    if (c.arguments().empty()) {
      EXPECT_THAT(c.text, testing::Not(testing::EndsWith("…"))) << c.name;
    }
  }
}

TEST(Commands, ShortcutsAreValidCalls) {
  for (const Command& c : commands()) {
    for (const Shortcut& s : c.shortcuts()) {
      const bool complete = c.arguments().empty() || c.arguments().front().optional;
      if (!s.values.empty() || complete) {
        EXPECT_NO_THROW(make_call(c.name, s.values)) << c.name;
      }
      EXPECT_FALSE(s.text().empty());
    }
  }
  EXPECT_EQ(find_command("step").keys(), "S, Space");
  EXPECT_EQ(find_command("quit").keys(), "Ctrl+Q");
  EXPECT_EQ(find_command("redo").keys(), "Ctrl+Y, Ctrl+Shift+Z");
  EXPECT_EQ(find_command("clear-selection").keys(), "Esc");
  EXPECT_EQ(find_command("shortcuts").keys(), "F1");
  EXPECT_EQ(find_command("panel").keys(), "") << "its keys bring values";
}

TEST(Commands, KeysThatTurnAndMoveTheSceneDoSoWithoutControl) {
  std::vector<std::string> keys;
  for (const char* name : {"turn", "zoom", "section-axis"})
    for (const Shortcut& s : find_command(name).shortcuts())
      keys.push_back(s.text() + ": " + make_call(name, s.values).text());
  EXPECT_THAT(keys, ElementsAre("Left: turn -10 0", "Right: turn 10 0", "Up: turn 0 10", "Down: turn 0 -10",
                                "=: zoom 1", "-: zoom -1", "X: section-axis"));
}

TEST(Commands, TheSidesOfTheObjectHaveTheDigitsWithControl) {
  std::vector<std::string> keys;
  for (const Shortcut& s : find_command("standard-view").shortcuts()) keys.push_back(s.text() + " " + s.values.front());
  EXPECT_THAT(keys, ElementsAre("Ctrl+1 front", "Ctrl+2 right", "Ctrl+3 back", "Ctrl+4 left", "Ctrl+5 top",
                                "Ctrl+6 bottom", "Ctrl+7 usual"));
}

/// Two commands may share a key only if there is no state in which both can be done; but what runs is cancelled before
/// what is selected is left (Front.EscapeCancelsWhatRunsAndElseSelectsNothing).
TEST(Commands, AKeyNeverMeansTwoThingsAtOnce) {
  std::map<std::string, std::vector<const Command*>> keys;
  for (const Command& c : commands())
    for (const Shortcut& s : c.shortcuts()) keys[s.text()].push_back(&c);
  for (int bits = 0; bits < 1 << 7; ++bits) {
    const auto bit = [&](int i) { return (bits >> i & 1) != 0; };
    SessionSnapshot session;
    if (bit(0)) session.session = 1;
    if (bit(0) && bit(1)) session.records.resize(1);
    if (bit(0) && bit(2)) session.finished = "it was enough";
    session.can_undo = session.can_redo = bit(0);
    WorkerProgress progress;
    progress.playing = bit(3);
    progress.refining = !bit(3) && bit(4);
    progress.paused = progress.refining && bit(5);
    progress.busy = progress.playing || progress.refining;
    WindowState window;
    if (bit(6)) window.selection.custom_view = Pose::Identity();
    for (const auto& [key, sharing] : keys) {
      if (key == "Esc") continue;
      const auto can = [&](const Command* c) { return c->available(state_of(session, progress, window)); };
      EXPECT_LE(std::count_if(sharing.begin(), sharing.end(), can), 1) << key << " in state " << bits;
    }
  }
}

TEST(Commands, NearestIsNamed) {
  EXPECT_THAT(error_of([] { make_call("stepp"); }), HasSubstr("did you mean 'step'?"));
  EXPECT_THAT(error_of([] { make_call("inspect-voxl"); }), HasSubstr("'inspect-voxel'"));
  EXPECT_THAT(error_of([] { find_command(""); }), HasSubstr("no command"));
}

TEST(Commands, WrongNumbersOfValuesShowTheUsage) {
  EXPECT_THAT(error_of([] { make_call("step", {"3"}); }), HasSubstr("no value"));
  EXPECT_THAT(error_of([] { make_call("select-view"); }), HasSubstr("select-view CANDIDATE"));
  EXPECT_THAT(error_of([] { make_call("inspect-voxel", {"0", "0"}); }), HasSubstr("inspect-voxel X Y Z"));
  EXPECT_THAT(error_of([] { make_call("take-view", {"1", "2"}); }), HasSubstr("take-view [CANDIDATE]"));
  EXPECT_NO_THROW(make_call("take-view"));
  EXPECT_NO_THROW(make_call("refine", {"3"}));
}

TEST(Commands, OfWordsWithoutQuotesTheQuotesAreTold) {
  const auto tells_quotes = HasSubstr("; what has blanks stands in double quotes");
  EXPECT_THAT(error_of([] { parse_call("caption Hello there"); }), tells_quotes);
  EXPECT_THAT(error_of([] { parse_call("caption Hello there, world"); }), tells_quotes);
  EXPECT_THAT(error_of([] { parse_call("open my part.stl"); }), tells_quotes);
  EXPECT_THAT(error_of([] { parse_call("inspect-voxel 0 0"); }), Not(tells_quotes));
  EXPECT_THAT(error_of([] { parse_call("caption"); }), Not(tells_quotes));
}

TEST(Commands, WrongValuesSayWhatTheyMustBe) {
  const std::string fraction = error_of([] { make_call("select-view", {"1.5"}); });
  EXPECT_THAT(fraction, HasSubstr("CANDIDATE must be a whole number from 0"));
  EXPECT_THAT(fraction, HasSubstr("not '1.5'"));
  for (const char* text : {"", "x", "1x", " 1", "nan", "inf", "-inf", "1e400", "-1", "61", "0x10", "1,5"})
    EXPECT_THAT(error_of([&] { make_call("speed", {text}); }), HasSubstr("a number from 0 to 60")) << text;
  EXPECT_THAT(error_of([] { make_call("voxel-map", {"both"}); }), HasSubstr("one of conventional, gibbs"));
  EXPECT_EQ(error_of([] {
              make_call("set", {"sensor.widht", "3"});
            }),
            "set: there is no KEY 'sensor.widht'; did you mean 'sensor.width'?");
  EXPECT_THAT(error_of([] { make_call("open", {""}); }), HasSubstr("must be given"));
  EXPECT_NO_THROW(make_call("speed", {"0"}));
  EXPECT_NO_THROW(make_call("speed", {"60"}));
  EXPECT_NO_THROW(make_call("look-from", {"-12.5", "3e1"}));
}

/// Each command with a value for each argument, as its declaration has it.
std::vector<CommandCall> some_calls() {
  std::vector<CommandCall> calls;
  for (const Command& c : commands()) {
    std::vector<std::string> values;
    for (const Argument& a : c.arguments()) {
      const bool number = a.kind == Argument::Kind::number || a.kind == Argument::Kind::whole;
      values.push_back(number                             ? std::to_string(int(std::ceil(a.low)))
                       : a.kind == Argument::Kind::choice ? a.choices({}).front()
                                                          : "a file.ply");
    }
    calls.push_back(make_call(c.name, values));
  }
  return calls;
}

TEST(Commands, AScriptHasWhatWasCalled) {
  std::string script;
  for (const CommandCall& call : some_calls()) {
    const CommandCall again = parse_call(call.text());
    EXPECT_EQ(again.command, call.command);
    EXPECT_EQ(again.values(), call.values()) << call.text();
    script += call.text() + "\n";
  }
  EXPECT_EQ(parse_script(script).size(), commands().size());
}

TEST(Commands, EveryTextSurvivesAScript) {
  for (const std::string text :
       {"plain", "two words", " led", "trailing ", "#1", "a#b", "tab\there", "say \"hi\"", "\"", "\"\"", "a\"b", "#\"",
        "back\\slash", "\\", "\\\"", "ends in \\", "übung", "it's"}) {
    const CommandCall call = make_call("export", {text});
    SCOPED_TRACE(call.text());
    ASSERT_NO_THROW(parse_call(call.text()));
    EXPECT_THAT(parse_call(call.text()).values(), ElementsAre(text));
  }
}

TEST(Commands, AScriptIsLinesAndComments) {
  const auto calls = parse_script(
      "# what it does\n"
      "\n"
      "step\r\n"
      "  play   # until it is done\n"
      "\topen \"two words.ply\" # not \"this\n"
      "export dir#1\n"
      "set planner.gain average-entropy");
  ASSERT_EQ(calls.size(), 5u);
  EXPECT_EQ(calls[0].text(), "step");
  EXPECT_EQ(calls[1].text(), "play");
  EXPECT_THAT(calls[2].values(), ElementsAre("two words.ply"));
  EXPECT_THAT(calls[3].values(), ElementsAre("dir#1"));
  EXPECT_THAT(calls[4].values(), ElementsAre("planner.gain", "average-entropy"));
  EXPECT_TRUE(parse_script("").empty());
  EXPECT_TRUE(parse_script("\n\n# nothing").empty());
}

TEST(Commands, AScriptsErrorsHaveItsLine) {
  EXPECT_THAT(error_of([] { parse_script("step\n\n# x\nstop\n"); }), StartsWith("line 4: there is no command 'stop'"));
  EXPECT_THAT(error_of([] { parse_script("open \"x\n"); }), StartsWith("line 1: a double quote is not closed"));
  EXPECT_THAT(error_of([] { parse_script("step\nstep 3\n"); }), StartsWith("line 2: step takes no value"));
  EXPECT_THAT(error_of([] { parse_script("step 3\n", "a/script.txt:"); }), StartsWith("a/script.txt:1: step takes"));
  EXPECT_THAT(error_of([] { parse_call("   # nothing"); }), HasSubstr("no command"));
}

TEST(Commands, WhatCannotBeDoneNowSaysWhy) {
  SessionWorker worker;
  WindowState window;
  const SessionSnapshot none;
  const WorkerProgress rest;
  CommandTarget target{worker, window, none, rest};
  EXPECT_EQ(error_of([&] { execute(make_call("step"), target); }), "step: there is no object yet");
  EXPECT_THAT(error_of([&] { execute(make_call("slice-at", {"0"}), target); }), HasSubstr("slice-axis"));
  EXPECT_EQ(worker.snapshot()->session, 0u);
}

TEST(Commands, WhoseGibbsMapIsKeptNowhereIsToldWhatKeepsIt) {
  SessionSnapshot session;
  auto map = std::make_shared<GibbsMap>();
  map->views = 2;
  session.gibbs = map;
  session.gibbs_lost = 2;
  const auto question = [&] { return command::quit.question({session, {}, {}}, {}).text; };
  EXPECT_THAT(question(),
              HasSubstr("The Gibbs map of 2 views is not kept with the session: refining (G) makes it again. To have "
                        "it as a file, cancel and export the scan (Ctrl+E)."));
  session.gibbs = nullptr;
  EXPECT_THAT(question(), HasSubstr("cancel, go to its view and export the scan")) << "one stands elsewhere";
  const auto of_opening = [&](const char* file) { return command::open.question({session, {}, {}}, {file}).text; };
  EXPECT_NE(of_opening("sphere"), "");
  EXPECT_EQ(of_opening("/no/such/part.stl"), "") << "it will be refused, and nothing is lost";
  EXPECT_EQ(of_opening("/dev/null"), "") << "nor is this an object";
  const TemporaryFolder folder;
  const std::string cut = folder.write("cut.stl", "solid cut\n").string();
  const std::string whole = folder.write("whole.stl", "solid whole\nendsolid whole\n").string();
  const std::string settings = folder.write("cut.toml", "object.file = '" + cut + "'\n").string();
  EXPECT_EQ(of_opening(cut.c_str()), "") << "nor this, as is seen before it is read for good";
  EXPECT_EQ(of_opening(settings.c_str()), "") << "nor what these settings scan";
  EXPECT_NE(of_opening(whole.c_str()), "");
  const auto of_scanner = [&](const Command& c) { return c.question({session, {}, {}}, {"driver"}).text; };
  EXPECT_NE(of_scanner(command::connect), "");
  EXPECT_NE(of_scanner(command::disconnect), "");
  session.gibbs_lost = 0;
  EXPECT_EQ(question(), "");
  EXPECT_EQ(of_opening("sphere"), "") << "undo brings all of it back";
  session.gibbs_lost_aside = 1;
  EXPECT_EQ(question(),
            "The Gibbs map of another scan, which was set aside, is kept nowhere: undo, or redo, brings it back, to be "
            "exported.");
  EXPECT_EQ(of_opening("sphere"), "") << "it still does";
  session.gibbs_lost_aside = 2;
  session.gibbs_lost = 3;
  EXPECT_THAT(question(),
              AllOf(StartsWith("The Gibbs map of 3 views is not kept"),
                    HasSubstr("(Ctrl+E). The Gibbs maps of 2 other scans, which were set aside, are kept")));
  session.gibbs_lost = session.gibbs_lost_aside = 0;
  session.live = true;
  EXPECT_THAT(of_opening("sphere"), StartsWith("The scanner is left, and what it does is stopped"));
  EXPECT_EQ(of_opening("/no/such/part.stl"), "");
}

TEST(Commands, WhatIsRefusedEndsNothingThatRuns) {
  SessionWorker worker;
  WindowState window;
  const SessionSnapshot none;
  WorkerProgress refining;
  refining.busy = true;
  CommandTarget target{worker, window, none, refining};
  EXPECT_THROW(execute(make_call("open", {"/no/such/part.stl"}), target), std::exception);
  EXPECT_THROW(execute(make_call("open", {"/no/such/settings.toml"}), target), std::exception);
  EXPECT_THROW(execute(make_call("open", {"/dev/null"}), target), std::exception) << "nor is this an object";
  const TemporaryFolder folder;
  const std::string cut = folder.write("cut.stl", "solid cut\n").string();
  EXPECT_THROW(execute(make_call("open", {cut}), target), std::exception) << "it is truncated";
  EXPECT_EQ(worker.posted(), 0u);
}

TEST(Commands, NoCommandNeedsASessionWithoutSayingSo) {
  SessionWorker worker;
  const SessionSnapshot none;
  const WorkerProgress rest;
  int refused = 0;
  for (const CommandCall& call : some_calls()) {
    const std::string& name = call.command->name;
    if (name == "save-script" || name == "open" || name == "play-demo") continue;  // they touch files
    WindowState window;
    CommandTarget target{worker, window, none, rest};
    try {
      execute(call, target);
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), StartsWith(name + ": "));
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST(Commands, TheTableHasARowForEach) {
  const std::string table = command_table();
  EXPECT_EQ(std::size_t(std::count(table.begin(), table.end(), '\n')), commands().size() + 2);
  for (const Command& c : commands()) EXPECT_THAT(table, HasSubstr("| `" + c.usage() + "` | ")) << c.name;
  EXPECT_THAT(table, HasSubstr("| S, Space | Takes the next view"));
  EXPECT_THAT(table, HasSubstr("F2 (session)"));
  std::size_t row = 0;
  for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1, ++row) {
    const std::string line = table.substr(at, table.find('\n', at) - at);
    EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 4) << line;
  }
}

}  // namespace
}  // namespace nextview
