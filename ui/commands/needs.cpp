#include "ui/commands/needs.hpp"

#include <fmt/format.h>

#include "core/file/counted.hpp"

namespace nextview {

std::string needs_session(const CommandState& t) {
  if (t.progress.opening) return "wait until it is open, or cancel that";
  return t.session.loaded() ? "" : "there is no object yet";
}

std::string needs_view(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  return t.session.records.empty() ? "take a view first" : "";
}

std::string needs_rest(const CommandState& t) {
  return t.progress.busy ? "wait until what runs is done, or cancel it" : "";
}

namespace {

std::string maps_set_aside(std::size_t maps) {
  const bool is_one = maps == 1;
  return fmt::format(
      "The Gibbs {}, which {} set aside, {} kept nowhere: undo, or redo, brings {} back, to be exported.",
      is_one ? "map of another scan" : fmt::format("maps of {} other scans", maps), is_one ? "was" : "were",
      is_one ? "is" : "are", is_one ? "it" : "them");
}

}  // namespace

std::string what_is_lost(const CommandState& t, bool undoable) {
  const SessionSnapshot& s = t.session;
  std::string lost;
  if (t.progress.refining)
    lost = "The Gibbs map is being sampled.";
  else if (s.gibbs_lost > 0 && !s.planned_on_posterior)
    lost = fmt::format(
        "The Gibbs map of {} is not kept with the session: refining (G) makes it again. To have it as a "
        "file, cancel{} and export the scan (Ctrl+E).",
        counted(s.gibbs_lost, "view"), s.gibbs ? "" : ", go to its view");
  if (!undoable && s.gibbs_lost_aside > 0) lost += (lost.empty() ? "" : " ") + maps_set_aside(s.gibbs_lost_aside);
  const std::size_t views = s.views_on_branches();
  if (!undoable && !s.kept && views > 0)
    lost += fmt::format("{}{} kept nowhere: Export keeps the scan.", lost.empty() ? "" : " ",
                        views == 1 ? "The view is" : fmt::format("The {} views are", views));
  return lost;
}

CommandQuestion restart_question(const CommandState& t, const std::string& what) {
  const std::size_t views = t.session.views_on_branches();
  const std::string lost = what_is_lost(t, true);
  if (views == 0) return {lost, "Start over"};
  return {fmt::format("{} starts the scan over. Its {} set aside: undo brings {} back.{}{}", what,
                      views == 1 ? "view is" : fmt::format("{} views are", views), views == 1 ? "it" : "them",
                      lost.empty() ? "" : " ", lost),
          "Start over"};
}

}  // namespace nextview
