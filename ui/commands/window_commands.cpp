#include "ui/commands/window_commands.hpp"

#include "ui/commands/command_target.hpp"

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

const CommandOf<> command::shortcuts{{"shortcuts",
                                      "Window",
                                      "Keys and mouse",
                                      "Shows or hides the sheet of keys.",
                                      {{Key::f1}},
                                      {},
                                      [](const WindowState& w) { return w.shortcuts_open; }},
                                     [](CommandTarget& t) { t.window.shortcuts_open = !t.window.shortcuts_open; }};

}  // namespace nextview
