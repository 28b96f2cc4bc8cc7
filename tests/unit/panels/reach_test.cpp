// Every command by mouse, by palette and by script.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/panels/desk.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

/// The command that calls stand for: itself, or the one that the palette or the file dialog asks values for.
void note(const std::vector<CommandCall>& calls, std::set<std::string>& reached) {
  for (const CommandCall& call : calls) {
    const auto values = call.values();
    const bool asks = (call.command->name == "palette" || call.command->name == "file-dialog") && !values.empty();
    reached.insert(asks ? values.front().substr(0, values.front().find(' ')) : call.command->name);
  }
}

/// The menu that is open, if one is.
const ImGuiWindow* open_menu() {
  const auto& stack = ImGui::GetCurrentContext()->OpenPopupStack;
  return stack.Size > 0 ? stack[0].Window : nullptr;
}

/// Apart from each other less than an item of a menu is high and the name of a menu is wide [px].
constexpr float item_step = 16;
constexpr double name_step = 20;

/// Clicks everything in the menu that opens at `x`.
void click_menu(Desk& desk, double x, std::set<float>& menus, std::set<std::string>& reached) {
  const double y = desk.layout().menu.height / 2;
  const WindowState before = desk.window;
  desk.click(x, y);
  desk.frames();
  const ImGuiWindow* menu = open_menu();
  if (!menu) return;
  const ImRect r = menu->Rect();
  const bool again = !menus.insert(r.Min.x).second;
  EXPECT_GE(r.Min.x, 0) << "a menu is outside of the window";
  EXPECT_LE(r.Max.y, desk.layout().status.y + desk.layout().status.height) << "a menu is outside of the window";
  for (float at = r.Min.y; at < r.Max.y && !again; at += item_step) {
    if (!open_menu()) desk.click(x, y);
    desk.frames();
    desk.click(r.Min.x + 20, at);
    note(desk.frames(), reached);
    desk.window = before;
  }
  if (open_menu()) desk.click(r.Max.x + 200, r.Max.y + 100);
  desk.frames();
  desk.window = before;
}

using Snapshots = std::vector<std::shared_ptr<const SessionSnapshot>>;

/// The desk's, that with the scan finished, and that of a live scanner.
Snapshots all_snapshots(const Desk& desk) {
  const auto finished = std::make_shared<SessionSnapshot>(*desk.snapshot);
  finished->finished = "5 views taken";
  finished->compared = nullptr;  // a surface is made of one branch
  const auto live = std::make_shared<SessionSnapshot>(*desk.snapshot);
  live->live = true;
  live->message = "the driver gave no answer";
  live->failures = 1;
  return {desk.snapshot, finished, live};
}

TEST(Reach, EveryCommandByMouseThroughTheMenu) {
  std::set<std::string> reached;
  std::vector<std::pair<std::size_t, WorkerProgress>> states;  // of a snapshot
  for (const WorkerProgress& progress : all_progress()) states.push_back({0, progress});
  states.push_back({1, {}});
  states.push_back({2, {}});
  Desk desk;
  open_all_ways(desk);
  const Snapshots snapshots = all_snapshots(desk);
  const WindowState opened = desk.window;
  for (const auto& [snapshot, progress] : states) {
    desk.window = opened;
    desk.progress = progress;
    desk.snapshot = snapshots[snapshot];
    if (snapshot == 1) desk.window.recording = DemoRecording{"a.nextview"};
    std::set<float> menus;
    for (double x = 10; x < 700; x += name_step) click_menu(desk, x, menus, reached);
    EXPECT_EQ(menus.size(), nextview::menus().size());
  }
  for (const Command& command : commands()) {
    if (command.name == "file-dialog") continue;  // which the commands that take a file open
    EXPECT_TRUE(reached.contains(command.name)) << command.name;
  }
}

/// A second click hits the menu's name, and no item of it.
TEST(Reach, MenusOpenBeneathTheBarHoweverLowTheWindow) {
  for (const int height : {480, 360}) {
    Desk desk(640, height);
    open_all_ways(desk);
    desk.frames();
    const double bar = desk.layout().menu.height;
    std::set<float> menus;
    for (double x = 10; x < 640; x += 15) {
      desk.click(x, bar / 2);
      desk.frames();
      const ImGuiWindow* const menu = open_menu();
      if (!menu) continue;
      menus.insert(menu->Pos.x);
      EXPECT_GE(menu->Pos.y, bar - 3) << x;
      EXPECT_LE(menu->Rect().Max.y, height) << x;
      desk.click(x, bar / 2);
      desk.frames();
      EXPECT_FALSE(open_menu()) << x;
    }
    EXPECT_EQ(menus.size(), nextview::menus().size());
  }
}

std::string valid_value(const Argument& argument, const SessionSnapshot& snapshot) {
  if (argument.choices) return argument.choices(snapshot).front();
  if (argument.kind == Argument::Kind::text) return "0.5";
  if (argument.kind == Argument::Kind::file) return "a_file";
  return std::to_string(int(std::ceil(argument.low)));
}

/// Brings the desk to where this command can be done: nothing runs, or what must; the scan goes on, or is finished.
void prepare_for(const Command& command, Desk& desk, const Snapshots& snapshots) {
  if (command.name == "record-stop") desk.window.recording = DemoRecording{"a.nextview"};
  for (const auto& snapshot : snapshots)
    for (const WorkerProgress& progress : all_progress()) {
      desk.snapshot = snapshot;
      desk.progress = progress;
      if (command.available(desk.state())) return;
    }
  ADD_FAILURE() << command.name << " can never be done";
}

TEST(Reach, EveryCommandThroughThePalette) {
  Desk desk;
  open_all_ways(desk);
  const Snapshots snapshots = all_snapshots(desk);
  const WindowState before = desk.window;
  for (const Command& command : commands()) {
    desk.window = before;
    prepare_for(command, desk, snapshots);
    desk.window.palette_open = true;
    desk.frames();
    desk.write(command.name);
    desk.type(Key::enter);
    std::vector<CommandCall> calls = desk.frames();
    std::string values;
    const bool asks = !command.needs_no_value();
    if (asks) {
      EXPECT_TRUE(calls.empty()) << command.name << " was done without its values";
      for (const Argument& argument : command.arguments())
        if (!argument.optional) values += (values.empty() ? "" : " ") + valid_value(argument, *desk.snapshot);
      desk.write(values);
      desk.type(Key::enter);
      calls = desk.frames();
    }
    ASSERT_FALSE(calls.empty()) << command.name << " " << values;
    EXPECT_EQ(calls.back().text(), command.name + (values.empty() ? "" : " " + values));
    desk.window = before;
    desk.frames();
  }
}

TEST(Reach, ThePaletteSaysWhatIsWrongAndStays) {
  Desk desk;
  open_all_ways(desk);
  for (const std::string text : {"select-view x", "nothing of the kind", "set planner.gain", "export \"x"}) {
    desk.window.palette_open = true;
    desk.frames();
    desk.write(text);
    desk.type(Key::enter);
    EXPECT_TRUE(desk.frames().empty()) << text;
    EXPECT_TRUE(desk.window.palette_open) << text;
    desk.type(Key::escape);
    desk.frames();
    EXPECT_FALSE(desk.window.palette_open) << text;
    desk.frames();
  }
}

TEST(Reach, EveryKeyDoesItsCommand) {
  Desk desk;
  open_all_ways(desk);
  const Snapshots snapshots = all_snapshots(desk);
  const WindowState before = desk.window;
  for (const Command& command : commands())
    for (const Shortcut& shortcut : command.shortcuts()) {
      desk.window = before;
      prepare_for(command, desk, snapshots);
      desk.frames();
      const ImGuiIO& io = ImGui::GetIO();
      EXPECT_FALSE(io.WantTextInput);
      std::set<std::string> reached;
      desk.type_with(shortcut.key, shortcut.control, shortcut.shift);
      note(desk.frames(), reached);
      EXPECT_EQ(reached, std::set<std::string>{command.name}) << shortcut.text();
      desk.window = before;
      desk.frames();
    }
}

TEST(Reach, EveryCommandByAScript) {
  Desk desk;
  open_all_ways(desk);
  for (const Command& command : commands()) {
    std::string line = command.name;
    for (const Argument& argument : command.arguments()) line += " " + valid_value(argument, *desk.snapshot);
    const auto calls = parse_script(line + "\n");
    ASSERT_EQ(calls.size(), 1u) << line;
    EXPECT_EQ(calls.front().text(), line);
  }
}

}  // namespace
}  // namespace nextview
