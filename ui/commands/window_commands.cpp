#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

const std::vector<std::string> panels = {"session",   "layers", "candidates", "view",
                                         "inspector", "gibbs",  "curves",     "log"};
const std::vector<std::string> curve_kinds = {"entropy", "coverage", "divergence", "gain", "time"};
const std::vector<std::string> columns = {"view", "gain", "cost", "utility"};
const std::vector<std::string> orders = {"ascending", "descending"};

}  // namespace

std::span<const std::string> panel_names() { return panels; }

std::vector<Command> window_commands() {
  std::vector<Shortcut> keys;
  for (std::size_t i = 0; i < panels.size(); ++i)
    keys.push_back({static_cast<Key>(static_cast<int>(Key::f2) + static_cast<int>(i)), false, {panels[i]}});
  return {
      {"panel",
       "Window",
       "Show a panel…",
       "Brings a panel to the front.",
       {choice("panel", "its name", panels)},
       keys,
       [](CommandTarget& t, const Arguments& a) {
         t.window.bring_to_front(static_cast<PanelName>(index_of(panels, a.text(0))));
       }},
      {"curves",
       "Window",
       "Choose the curves…",
       "Chooses what the two plots show.",
       {choice("left", "of the left plot", curve_kinds), choice("right", "of the right plot", curve_kinds)},
       {},
       [](CommandTarget& t, const Arguments& a) {
         for (std::size_t i = 0; i < 2; ++i)
           t.window.curves[i] = static_cast<CurveKind>(index_of(curve_kinds, a.text(i)));
         t.window.bring_to_front(PanelName::curves);
       }},
      {"forget-runs",
       "Window",
       "Forget earlier runs",
       "Takes the curves of earlier runs away.",
       {},
       {},
       [](CommandTarget& t, const Arguments&) { t.worker.post(request::ForgetRuns{}); },
       [](const CommandState& t) { return t.session.earlier_runs ? "" : "there is no earlier run"; }},
      {"sort",
       "Window",
       "Sort the candidates…",
       "Sorts the table of candidates.",
       {choice("column", "by which column", columns), choice("order", "ascending or descending", orders)},
       {},
       [](CommandTarget& t, const Arguments& a) {
         t.window.sort_column = static_cast<CandidateColumn>(index_of(columns, a.text(0)));
         t.window.sort_ascending = index_of(orders, a.text(1)) == 0;
       }},
      {"palette",
       "Window",
       "All commands…",
       "Opens or closes the list of all commands: type a part of a name, or a line of a script.",
       {{"text", Argument::Kind::text, "what it starts with", 0, 0, {}, true}},
       {{key('P'), true}},
       [](CommandTarget& t, const Arguments& a) {
         t.window.palette_open = a.count() > 0 || !t.window.palette_open;
         t.window.palette_text = a.count() > 0 ? a.text(0) : "";
       },
       {},
       [](const WindowState& w) { return w.palette_open; }},
      {"shortcuts",
       "Window",
       "Keys and mouse",
       "Shows or hides the sheet of keys.",
       {},
       {{Key::f1}},
       [](CommandTarget& t, const Arguments&) { t.window.shortcuts_open = !t.window.shortcuts_open; },
       {},
       [](const WindowState& w) { return w.shortcuts_open; }},
  };
}

}  // namespace nextview
