#pragma once
#include <cstdint>
#include <vector>

#include "ui/workbench/selection.hpp"

namespace nextview {

/// Selections to go back to, each between the changes of the session that it was made between: undo takes back what was
/// done last, whichever of the two it was.
class SelectionHistory {
 public:
  /// What the session's numbers mean, and the last change that was made to it.
  struct Moment {
    std::uint64_t session = 0, change = 0;

    bool operator==(const Moment&) const = default;
  };

  /// Another selection took the place of `before`.
  void push(const Selection& before, const Moment& now);
  bool can_undo(const Moment& now) const { return is_at(undo_, now); }
  bool can_redo(const Moment& now) const { return is_at(redo_, now); }
  /// The selection before, or after again; `now` is the one of now. @pre can_undo(), can_redo()
  Selection undo(const Selection& now) { return travel(undo_, redo_, now); }
  Selection redo(const Selection& now) { return travel(redo_, undo_, now); }

 private:
  struct Entry {
    Selection selection;
    Moment moment;
  };
  using Entries = std::vector<Entry>;
  static bool is_at(const Entries& entries, const Moment& now) {
    return !entries.empty() && entries.back().moment == now;
  }
  static Selection travel(Entries& from, Entries& to, const Selection& now);

  Entries undo_, redo_;
};

}  // namespace nextview
