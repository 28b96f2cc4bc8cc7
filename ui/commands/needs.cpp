#include "ui/commands/needs.hpp"

namespace nextview {

std::string needs_session(const CommandState& t) { return t.session.loaded() ? "" : "there is no object yet"; }

std::string needs_view(const CommandState& t) {
  if (!t.session.loaded()) return "there is no object yet";
  return t.session.records.empty() ? "take a view first" : "";
}

std::string needs_rest(const CommandState& t) {
  return t.progress.busy ? "wait until what runs is done, or cancel it" : "";
}

}  // namespace nextview
