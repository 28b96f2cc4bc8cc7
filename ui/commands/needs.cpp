#include "ui/commands/needs.hpp"

#include <fmt/format.h>

#include "core/file/counted.hpp"

namespace nextview {

std::string needs_session(const CommandState& t) { return t.session.loaded() ? "" : "there is no object yet"; }

std::string needs_view(const CommandState& t) {
  if (!t.session.loaded()) return "there is no object yet";
  return t.session.records.empty() ? "take a view first" : "";
}

std::string needs_rest(const CommandState& t) {
  return t.progress.busy ? "wait until what runs is done, or cancel it" : "";
}

std::string what_is_lost(const CommandState& t, bool undoable) {
  const SessionSnapshot& s = t.session;
  std::string lost;
  if (t.progress.refining)
    lost = "The Gibbs map is being sampled.";
  else if (s.gibbs && !s.planned_on_posterior)
    lost = fmt::format("The Gibbs map of {} is kept nowhere.", counted(s.gibbs->views, "view"));
  if (!undoable && !s.kept && !s.records.empty())
    lost += fmt::format("{}{} kept nowhere: Export keeps the scan.", lost.empty() ? "" : " ",
                        s.records.size() == 1 ? "The view is" : fmt::format("The {} views are", s.records.size()));
  return lost;
}

}  // namespace nextview
