#pragma once
#include <memory>
#include <vector>

#include "tests/unit/panels/desk.hpp"

namespace nextview {

/// A scan in a state that panels may find it in.
class State {
 public:
  using Snapshot = std::shared_ptr<const SessionSnapshot>;

  State(const char* title, Snapshot (*make)()) : name(title), make_(make) {}
  /// Made when it is first asked for: many tests are of one state.
  const Snapshot& snapshot() const {
    if (!made_) made_ = make_();
    return made_;
  }

  const char* name;

 private:
  Snapshot (*make_)();
  mutable Snapshot made_;
};

inline std::shared_ptr<const SessionSnapshot> with_gain(const char* gain) {
  Configuration c = small_scan();
  c.planner.gain = gain;
  return scanned(c, 2);
}

inline std::shared_ptr<const SessionSnapshot> with_candidates(int count) {
  Configuration c = small_scan();
  c.views.count = count;
  return scanned(c, 1);
}

inline std::shared_ptr<const SessionSnapshot> without_evaluation() {
  Configuration blind = small_scan();
  blind.evaluation.enabled = false;
  return scanned(blind, 2, true);
}

inline std::shared_ptr<const SessionSnapshot> that_failed() {
  auto failed = std::make_shared<SessionSnapshot>(*scanned(small_scan(), 1));
  failed->message = "cannot read '/a/rather/long/way/to/a/file/that/is/not/there.ply': no such file or directory";
  return failed;
}

inline const std::vector<State>& states() {
  using Snapshot = State::Snapshot;
  static const std::vector<State> all{{"empty", []() -> Snapshot { return std::make_shared<SessionSnapshot>(); }},
                                      {"before the first step", [] { return scanned(small_scan(), 0); }},
                                      {"after steps", [] { return scanned(small_scan(), 2); }},
                                      {"refined", [] { return scanned(small_scan(), 2, true); }},
                                      {"finished", [] { return scanned(small_scan(), 4); }},
                                      {"without evaluation", without_evaluation},
                                      {"combined", [] { return with_gain("combined"); }},
                                      {"random", [] { return with_gain("random"); }},
                                      {"one candidate", [] { return with_candidates(1); }},
                                      {"500 candidates", [] { return with_candidates(500); }},
                                      {"failed", that_failed}};
  return all;
}

}  // namespace nextview
