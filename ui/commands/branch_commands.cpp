#include "ui/commands/branch_commands.hpp"

#include <algorithm>

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

std::vector<std::string> branch_names(const SessionSnapshot& s) {
  std::vector<std::string> names;
  if (s.timeline)
    for (const Branch& branch : s.timeline->branches.all) names.push_back(branch.name);
  return names;
}

std::string previous_why_not(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  return t.session.records.empty() ? "no view has been taken yet" : "";
}

std::string next_why_not(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  const auto& timeline = t.session.timeline;
  const bool is_last = !timeline || timeline->at == timeline->branches.current().tip;
  return is_last ? "it is the last view of this branch" : "";
}

ArgumentOf<std::string> branch_name(const char* help, Argument::Choices names) {
  return argument::text("branch", help, std::move(names));
}

/// Goes along the current branch by a view, past those whose captures are lost.
void go_by(CommandTarget& t, int by) {
  const Timeline& timeline = *t.session.timeline;
  const auto line = timeline.line(timeline.branches.current());
  auto views = static_cast<std::ptrdiff_t>(timeline.line(timeline.at).size());
  do {
    views += by;
  } while (views > 0 && views < std::ssize(line) && !line[std::size_t(views) - 1]->picture);
  t.worker.post(request::GoTo{timeline.branches.current().name, std::size_t(std::max<std::ptrdiff_t>(views, 0))});
}

}  // namespace

std::vector<std::string> other_branches(const SessionSnapshot& s) {
  std::vector<std::string> names = branch_names(s);
  if (!names.empty()) std::erase(names, s.timeline->branches.current().name);
  return names;
}

std::string needs_other_branch(const CommandState& t) {
  if (const std::string reason = needs_session(t); !reason.empty()) return reason;
  return other_branches(t.session).empty() ? "there is no other branch yet: begin one with branch" : "";
}

const CommandOf<std::size_t, std::optional<std::string>> command::go_to_view{
    {"go-to-view",
     "Timeline",
     "Go to a view…",
     "Goes to where the scan had so many views: nothing is captured, and all views stay.",
     {},
     needs_session},
    argument::whole("views", "0: before the first", 0, 1e6),
    argument::optional(branch_name("that has them; else the current one", branch_names)),
    [](CommandTarget& t, std::size_t views, const std::optional<std::string>& name) {
      t.worker.post(request::GoTo{name.value_or(""), views});
    }};

const CommandOf<> command::previous_view{{"previous-view",
                                          "Timeline",
                                          "Go to the view before",
                                          "Goes back by a view; it stays in the timeline.",
                                          {{Key::page_up}},
                                          previous_why_not},
                                         [](CommandTarget& t) { go_by(t, -1); }};

const CommandOf<> command::next_view{{"next-view",
                                      "Timeline",
                                      "Go to the view after",
                                      "Goes forward by a view that was taken on this branch.",
                                      {{Key::page_down}},
                                      next_why_not},
                                     [](CommandTarget& t) { go_by(t, 1); }};

const CommandOf<std::optional<std::string>> command::branch{
    {"branch",
     "Timeline",
     "Begin a branch here",
     "What is taken from here on is on a branch of its own. Going back and taking a view begins one by itself.",
     {{key('B')}},
     needs_session},
    argument::optional(argument::text("name", "of the branch; else one that is free")),
    [](CommandTarget& t, const std::optional<std::string>& name) {
      t.worker.post(request::BeginBranch{name.value_or("")});
    }};

const CommandOf<std::string> command::go_to_branch{
    {"go-to-branch",
     "Timeline",
     "Go to a branch…",
     "Goes to the end of another branch, with its planner.",
     {},
     needs_other_branch},
    branch_name("its name", branch_names),
    [](CommandTarget& t, const std::string& name) { t.worker.post(request::GoTo{name}); }};

const CommandOf<std::string, std::string> command::rename_branch{
    {"rename-branch", "Timeline", "Rename a branch…", "Gives a branch another name.", {}, needs_session},
    branch_name("its name", branch_names),
    argument::text("to", "its new name"),
    [](CommandTarget& t, const std::string& name, const std::string& to) {
      t.worker.post(request::RenameBranch{name, to});
    }};

const CommandOf<std::string> command::remove_branch{
    {"remove-branch",
     "Timeline",
     "Remove a branch…",
     "Takes a branch out of the timeline; undo brings it back, and its captures stay in the session's folder.",
     {},
     needs_other_branch},
    branch_name("its name", other_branches),
    [](CommandTarget& t, const std::string& name) { t.worker.post(request::RemoveBranch{name}); }};

const CommandOf<std::string> command::compare{
    {"compare",
     "Timeline",
     "Compare with a branch…",
     "Shows another branch beside this one: its scene, its curves, and what differs.",
     {},
     needs_other_branch},
    branch_name("its name", other_branches),
    [](CommandTarget& t, const std::string& name) {
      t.worker.post(request::Compare{name});
      t.window.bring_to_front(panel_name::comparison);
    }};

const CommandOf<> command::stop_comparing{
    {"stop-comparing",
     "Timeline",
     "Stop comparing",
     "Shows this branch alone again.",
     {},
     [](const CommandState& t) { return t.session.compared ? "" : "no branch is compared"; }},
    [](CommandTarget& t) { t.worker.post(request::Compare{}); }};

}  // namespace nextview
