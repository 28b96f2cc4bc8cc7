#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/commands/key.hpp"
#include "ui/commands/window_state.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {

/// What decides whether a command can be done now.
struct CommandState {
  const SessionSnapshot& session;
  const WorkerProgress& progress;
  const WindowState& window;
};

/// What a command looks at and acts on.
struct CommandTarget {
  SessionWorker& worker;
  WindowState& window;
  const SessionSnapshot& session;
  const WorkerProgress& progress;

  CommandState state() const { return {session, progress, window}; }
};

/// A value that a command takes.
struct Argument {
  enum class Kind { number, whole, text, choice, file };
  std::string name;  ///< "candidate"
  Kind kind = Kind::text;
  std::string help;  ///< what it is, with its unit
  double low = -1e9, high = 1e9;
  std::function<std::vector<std::string>(const SessionSnapshot&)> choices = {};  ///< all there are, or suggestions
  bool optional = false;                                                         ///< this and all that follow it
};

/// The values of one call, checked against the declaration.
class Arguments {
 public:
  Arguments(std::span<const std::string> texts) : texts_(texts) {}
  std::size_t count() const { return texts_.size(); }
  const std::string& text(std::size_t i) const { return texts_[i]; }
  double number(std::size_t i) const;
  std::size_t whole(std::size_t i) const { return static_cast<std::size_t>(number(i)); }

 private:
  std::span<const std::string> texts_;
};

struct Shortcut {
  Key key;
  bool control = false;
  std::vector<std::string> arguments = {};

  std::string text() const;  ///< "Ctrl+P"
};

/// Something that a person can do, declared once: menus, the palette, the sheet of shortcuts, scripts and the README's
/// table are made of these.
struct Command {
  std::string name;  ///< in scripts: "take-view"
  std::string menu;  ///< where it stands: "Scan"
  std::string text;  ///< for people: "Take a view next"
  std::string help;  ///< one sentence: the tooltip
  std::vector<Argument> arguments = {};
  std::vector<Shortcut> shortcuts = {};
  std::function<void(CommandTarget&, const Arguments&)> run;
  std::function<std::string(const CommandState&)> why_not = {};  ///< it cannot be done now; empty: it can
  std::function<bool(const WindowState&)> on = {};               ///< of what is switched on and off
  bool adds_up = false;                                          ///< doing it twice is more than doing the last alone

  bool available(const CommandState& state) const { return !why_not || why_not(state).empty(); }
  std::string keys() const;   ///< "S, Space"; empty if it has none
  std::string usage() const;  ///< "take-view CANDIDATE"
};

/// All commands, in the order of the menus.
std::span<const Command> commands();
/// The menus' names, in their order.
std::vector<std::string> menus();
/// @throws std::invalid_argument naming the nearest one.
const Command& find_command(std::string_view name);

/// A command with its values: what panels emit, and a line of a script.
struct CommandCall {
  const Command* command;
  std::vector<std::string> arguments;
  int line = 0;  ///< of the script that it is from, from 1; 0: it is from none

  std::string text() const;  ///< as a script has it
};

/// @throws std::invalid_argument in one line: no such command, too many or too few values, or what a value must be.
CommandCall make_call(std::string_view name, std::vector<std::string> arguments = {});
/// A line of a script: a command's name and its values, those with spaces in double quotes (in which "" means one).
CommandCall parse_call(std::string_view line);
/// The calls of a script: a line each; what follows a # is a comment. @throws std::invalid_argument "line 3: …"
std::vector<CommandCall> parse_script(std::string_view text);

/// Does it. @throws std::invalid_argument saying why it cannot be done now.
void execute(const CommandCall& call, CommandTarget& target);

/// The README's table: a row a command.
std::string command_table();

}  // namespace nextview
