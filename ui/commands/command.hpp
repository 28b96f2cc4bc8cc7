#pragma once
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "ui/commands/argument.hpp"
#include "ui/commands/key.hpp"
#include "ui/commands/window_state.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

class Command;
struct CommandTarget;  // what a command acts on: command_target.hpp

/// What decides whether a command can be done now.
struct CommandState {
  const SessionSnapshot& session;
  const WorkerProgress& progress;
  const WindowState& window;
};

/// A command with its values, to be done: what panels post, and a line of a script.
struct CommandCall {
  const Command* command;
  std::function<void(CommandTarget&)> run;           ///< @throws std::invalid_argument saying why it cannot be done
  std::function<std::vector<std::string>()> values;  ///< as a script has them
  int line = 0;                                      ///< of the script that it is from, from 1; 0: it is from none

  std::string text() const;  ///< as a script has it
};

struct Shortcut {
  Key key;
  bool control = false;
  std::vector<std::string> values = {};  ///< of its call, as a script has them
  bool shift = false;                    ///< counts of letters with Control alone: + is Shift and = on many keyboards

  /// Whether the key is meant, with these two held.
  bool is_with(bool control_held, bool shift_held) const;
  std::string text() const;  ///< "Ctrl+P"
};

/// The keys of a command: fixed, or made when asked for, of what is known only while the program runs.
class Shortcuts {
 public:
  using Made = std::vector<Shortcut> (*)();

  Shortcuts() = default;
  Shortcuts(std::initializer_list<Shortcut> fixed) : fixed_(fixed) {}
  Shortcuts(Made made) : made_(made) {}
  std::vector<Shortcut> operator()() const { return made_ ? made_() : fixed_; }

 private:
  std::vector<Shortcut> fixed_;
  Made made_ = nullptr;
};

/// What people are asked before something is done.
struct CommandQuestion {
  std::string text;     ///< what it costs, and whether; empty: nothing is asked
  std::string confirm;  ///< the answer by which it is done: "Start over"
  /// Another answer, "Export…", and what is done by it; empty: there is none.
  std::string other = {};
  std::optional<CommandCall> instead = {};
};

/// What people see of a command, and when it can be done.
struct CommandDeclaration {
  std::string name;  ///< in scripts: "take-view"
  std::string menu;  ///< where it stands: "Scan"
  std::string text;  ///< for people: "Take a view next"
  std::string help;  ///< one sentence: the tooltip
  Shortcuts shortcuts = {};
  std::function<std::string(const CommandState&)> why_not = {};  ///< it cannot be done now; empty: it can
  std::function<bool(const WindowState&)> on = {};               ///< of what is switched on and off
  bool adds_up = false;                                          ///< doing it twice is more than doing the last alone
  /// Asked with the values that it has, as a script has them; scripts are not asked.
  std::function<CommandQuestion(const CommandState&, const std::vector<std::string>&)> question = {};
  /// Other ways in which a script may write its values, turned into those that are declared.
  std::function<std::vector<std::string>(std::vector<std::string>)> respell = {};
  bool writes = false;  ///< its first value is a file or folder that it writes; a demo does so below --out only
};

/// Something that the user can do, declared once: menus, the palette, the sheet of shortcuts, scripts and the manual's
/// table are made of these.
class Command : public CommandDeclaration {
 public:
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  const std::vector<Argument>& arguments() const { return arguments_; }
  /// Whether it can be called without a value.
  bool needs_no_value() const { return arguments_.empty() || arguments_.front().optional; }
  bool takes_file() const { return !arguments_.empty() && arguments_.front().kind == Argument::Kind::file; }
  bool names_folder() const { return !arguments_.empty() && arguments_.front().name == "folder"; }
  /// Why it cannot be done now; empty: it can. While something is asked, the session takes nothing but the answer.
  std::string why_not_now(const CommandState& state) const;
  bool available(const CommandState& state) const { return why_not_now(state).empty(); }
  std::string keys() const;   ///< "S, Space"; empty if it has none
  std::string usage() const;  ///< "take-view CANDIDATE"

  /// With values as a script or the user writes them.
  /// @throws std::invalid_argument in one line: too many or too few of them, or what one must be.
  CommandCall read(std::vector<std::string> values) const;

 protected:
  Command(CommandDeclaration declaration, std::vector<Argument> arguments);
  virtual CommandCall read_values(std::vector<std::string> values) const = 0;

 private:
  std::vector<Argument> arguments_;
};

template <class Value>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

/// A command and what it does, a function of typed values. Called with values it does nothing yet: it makes the call
/// that does.
template <class... Values>
class CommandOf : public Command {
 public:
  using Function = std::function<void(CommandTarget&, const Values&...)>;

  CommandOf(CommandDeclaration declaration, ArgumentOf<Values>... arguments, Function function)
      : Command(std::move(declaration), {std::move(arguments)...}), function_(std::move(function)) {}

  /// What is not given is optional.
  template <class... Given>
  CommandCall operator()(const Given&... given) const {
    static_assert(sizeof...(Given) <= sizeof...(Values), "too many values");
    static_assert(sizeof...(Given) >= (std::size_t{0} + ... + std::size_t{!is_optional<Values>}), "too few values");
    std::tuple<Values...> values;
    assign(values, std::index_sequence_for<Given...>(), given...);
    return call(values, [this, values] { return texts(values); });
  }

 private:
  CommandCall call(std::tuple<Values...> values, std::function<std::vector<std::string>()> written) const {
    return {this, [this, values = std::move(values)](CommandTarget& target) { run(target, values); },
            std::move(written)};
  }

  template <std::size_t... index, class... Given>
  static void assign(std::tuple<Values...>& values, std::index_sequence<index...>, const Given&... given) {
    ((std::get<index>(values) = given), ...);
  }

  void run(CommandTarget& target, const std::tuple<Values...>& values) const {
    const auto checked = [&](const Values&... value) {
      [[maybe_unused]] auto argument = arguments().begin();
      (argument++->check(value), ...);
      function_(target, value...);
    };
    std::apply(checked, values);
  }

  std::vector<std::string> texts(const std::tuple<Values...>& values) const {
    std::vector<std::string> result;
    const auto write = [&](const Values&... value) {
      [[maybe_unused]] auto argument = arguments().begin();
      static_cast<void>((argument++->write(value, result) && ...));
    };
    std::apply(write, values);
    return result;
  }

  CommandCall read_values(std::vector<std::string> written) const override {
    std::tuple<Values...> values;
    std::size_t next = 0;
    const auto read_next = [&](auto& value) {
      if (next < written.size()) arguments()[next].read(written[next], value);
      ++next;
    };
    std::apply([&](Values&... value) { (read_next(value), ...); }, values);
    return call(std::move(values), [written = std::move(written)] { return written; });
  }

  Function function_;
};

}  // namespace nextview
