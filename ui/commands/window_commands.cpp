#include "ui/commands/window_commands.hpp"

#include <algorithm>

#include "ui/commands/command_list.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/manual/manual.hpp"

namespace nextview {
namespace {

// In the order of CurveKind and CandidateColumn.
const std::vector<std::string> curve_kinds = {"entropy", "coverage", "divergence", "gain", "time"};
const std::vector<std::string> columns = {"view", "gain", "cost", "utility"};

/// F2 and on, as far as there are keys.
std::vector<Shortcut> panel_keys() {
  std::vector<Shortcut> keys;
  int key = static_cast<int>(Key::f2);
  for (const PanelInfo& panel : panel_list())
    if (key <= static_cast<int>(Key::f12)) keys.push_back({static_cast<Key>(key++), false, {panel.name}});
  return keys;
}

std::vector<std::string> file_takers() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    if (command.takes_file()) names.push_back(command.name);
  return names;
}

}  // namespace

const CommandOf<std::string> command::panel{
    {"panel", "Window", "Show a panel…", "Brings a panel to the front.", panel_keys},
    argument::name("panel", "its name", [](const SessionSnapshot&) { return panel_names(); }),
    [](CommandTarget& t, const std::string& chosen) { t.window.bring_to_front(chosen); }};

const CommandOf<CurveKind, CurveKind> command::curves{
    {"curves", "Window", "Choose the curves…", "Chooses what the two plots show."},
    argument::choice<CurveKind>("left", "of the left plot", curve_kinds),
    argument::choice<CurveKind>("right", "of the right plot", curve_kinds),
    [](CommandTarget& t, CurveKind left, CurveKind right) {
      t.window.curves = {left, right};
      t.window.bring_to_front(panel_name::curves);
    }};

const CommandOf<> command::forget_runs{
    {"forget-runs",
     "Window",
     "Forget earlier runs",
     "Takes the curves of earlier runs away.",
     {},
     [](const CommandState& t) { return t.session.earlier_runs ? "" : "there is no earlier run"; }},
    [](CommandTarget& t) { t.worker.post(request::ForgetRuns{}); }};

const CommandOf<> command::dismiss{{"dismiss",
                                    "Window",
                                    "Hide the message",
                                    "Takes what failed last from the status line. The log keeps it.",
                                    {},
                                    [](const CommandState& t) {
                                      const bool is_shown = !t.session.message.empty() &&
                                                            t.window.dismissed_failure != t.session.failures;
                                      return is_shown ? "" : "there is no message";
                                    }},
                                   [](CommandTarget& t) { t.window.dismissed_failure = t.session.failures; }};

const CommandOf<CandidateColumn, SortOrder> command::sort{
    {"sort", "Window", "Sort the candidates…", "Sorts the table of candidates."},
    argument::choice<CandidateColumn>("column", "by which column", columns),
    argument::choice<SortOrder>("order", "ascending or descending", {"ascending", "descending"}),
    [](CommandTarget& t, CandidateColumn column, SortOrder order) {
      t.window.sort_column = column;
      t.window.sort_ascending = order == SortOrder::ascending;
    }};

const CommandOf<std::optional<std::string>> command::palette{
    {"palette",
     "Window",
     "All commands…",
     "Opens or closes the list of all commands: type a part of a name, or a line of a script.",
     {{key('P'), true}},
     {},
     [](const WindowState& w) { return w.palette_open; }},
    argument::optional(argument::text("text", "what it starts with")),
    [](CommandTarget& t, const std::optional<std::string>& text) {
      t.window.palette_open = text || !t.window.palette_open;
      t.window.palette_text = text.value_or("");
    }};

const CommandOf<std::optional<std::string>> command::file_dialog{
    {"file-dialog", "Window", "Choose a file…",
     "Opens the file dialog for a command that takes a file, such as open or export, or closes it."},
    argument::optional(
        argument::name("command", "that takes a file", [](const SessionSnapshot&) { return file_takers(); })),
    [](CommandTarget& t, const std::optional<std::string>& taker) {
      t.window.file_for = taker || !t.window.file_for.empty() ? taker.value_or("") : "open";
    }};

const CommandOf<TextSize> command::text_size{
    {"text-size",
     "Window",
     "Size of text and controls…",
     "Makes text and controls bigger or smaller, or of the display's usual size; it is kept for the next start.",
     {{key('='), true, {"bigger"}}, {key('-'), true, {"smaller"}}, {key('0'), true, {"usual"}}},
     {},
     {},
     true},
    argument::choice<TextSize>("size", "than it is now", {"smaller", "usual", "bigger"}),
    [](CommandTarget& t, TextSize size) {
      double& scale = t.window.text_scale;
      const double wanted = size == TextSize::usual ? 1.0 : size == TextSize::bigger ? scale * 1.25 : scale / 1.25;
      scale = std::clamp(wanted, 0.64, 3.0517578125);
    }};

const CommandOf<> command::dark{{"dark",
                                 "Window",
                                 "Dark",
                                 "Makes the window dark, or light again; it is kept for the next start.",
                                 {},
                                 {},
                                 [](const WindowState& w) { return w.dark; }},
                                [](CommandTarget& t) { t.window.dark = !t.window.dark; }};

const CommandOf<double, double, double> command::panel_sizes{
    {"panel-sizes", "Window", "Sizes of the panels…",
     "How wide the panels at the left and at the right are, and how high those below. Or drag their borders; a double "
     "click on one gives it its usual place."},
    argument::number("left", "[px]", PlaceSizes::smallest, PlaceSizes::largest),
    argument::number("right", "[px]", PlaceSizes::smallest, PlaceSizes::largest),
    argument::number("lower", "[px]", PlaceSizes::smallest, PlaceSizes::largest),
    [](CommandTarget& t, double left, double right, double lower) {
      t.window.place_sizes = {left, right, lower};
    }};

const CommandOf<> command::hide_panels{{"hide-panels",
                                        "Window",
                                        "The scene alone",
                                        "Hides all panels, or shows them again.",
                                        {{key('H'), true}},
                                        {},
                                        [](const WindowState& w) { return w.panels_hidden; }},
                                       [](CommandTarget& t) { t.window.panels_hidden = !t.window.panels_hidden; }};

const CommandOf<> command::full_screen{{"full-screen",
                                        "Window",
                                        "Full screen",
                                        "Gives the window the whole screen, or its former place.",
                                        {{Key::f12}},
                                        {},
                                        [](const WindowState& w) { return w.full_screen; }},
                                       [](CommandTarget& t) { t.window.full_screen = !t.window.full_screen; }};

const CommandOf<> command::guide{
    {"guide", "Help", "First steps", "Shows or hides what to do first; of itself it is shown until a view is taken."},
    [](CommandTarget& t) {
      const bool show = !t.window.shows_guide(t.session);
      t.window.guide_open = t.window.guide_asked = show;
    }};

const CommandOf<> command::shortcuts{{"shortcuts",
                                      "Help",
                                      "Keys and mouse",
                                      "Shows or hides the sheet of keys.",
                                      {{Key::f1}},
                                      {},
                                      [](const WindowState& w) { return w.shortcuts_open; }},
                                     [](CommandTarget& t) { t.window.shortcuts_open = !t.window.shortcuts_open; }};

const CommandOf<std::optional<std::string>> command::manual{
    {.name = "manual",
     .menu = "Help",
     .text = "Manual",
     .help = "Opens the manual, at a topic if one is given, or closes it; `nextview help` prints it.",
     .on = [](const WindowState& w) { return w.manual.has_value(); }},
    argument::optional(argument::name("topic", "a page", [](const SessionSnapshot&) { return manual_topics(); })),
    [](CommandTarget& t, const std::optional<std::string>& topic) {
      if (topic || !t.window.manual)
        t.window.manual = topic.value_or(manual_topics().front());
      else
        t.window.manual.reset();
    }};

}  // namespace nextview
