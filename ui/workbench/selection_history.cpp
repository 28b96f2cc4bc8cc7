#include "ui/workbench/selection_history.hpp"

#include <utility>

namespace nextview {
namespace {

constexpr std::size_t max_entries = 200;

}  // namespace

void SelectionHistory::push(const Selection& before, const Moment& now) {
  redo_.clear();
  // Those of a change that was undone since, or of another session, lead nowhere.
  std::erase_if(undo_, [&](const Entry& e) { return e.moment.session != now.session || e.moment.change > now.change; });
  if (undo_.size() == max_entries) undo_.erase(undo_.begin());
  undo_.push_back({before, now});
}

Selection SelectionHistory::travel(Entries& from, Entries& to, const Selection& now) {
  Entry entry = std::move(from.back());
  from.pop_back();
  to.push_back({now, entry.moment});
  return std::move(entry.selection);
}

}  // namespace nextview
