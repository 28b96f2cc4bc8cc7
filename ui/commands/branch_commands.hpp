#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::size_t, std::optional<std::string>> go_to_view;  ///< views, and the branch that has them
extern const CommandOf<> previous_view, next_view, stop_comparing;
extern const CommandOf<std::optional<std::string>> branch;  ///< its name, or the next that is free
extern const CommandOf<std::string> go_to_branch, remove_branch, compare;
extern const CommandOf<std::string, std::string> rename_branch;

}  // namespace nextview::command

namespace nextview {

std::vector<std::string> other_branches(const SessionSnapshot& session);  ///< than the current one, by name
std::string needs_other_branch(const CommandState& state);                ///< why_not: as those of needs.hpp

}  // namespace nextview
