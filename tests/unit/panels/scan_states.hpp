#pragma once
#include <memory>
#include <vector>

#include "tests/unit/panels/desk.hpp"

namespace nextview {

/// A scan in a state that panels may find it in.
struct State {
  const char* name;
  std::shared_ptr<const SessionSnapshot> snapshot;
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

inline const std::vector<State>& states() {
  static const std::vector<State> all = [] {
    Configuration blind = small_scan();
    blind.evaluation.enabled = false;
    auto failed = std::make_shared<SessionSnapshot>(*scanned(small_scan(), 1));
    failed->message = "cannot read '/a/rather/long/way/to/a/file/that/is/not/there.ply': no such file or directory";
    return std::vector<State>{{"empty", std::make_shared<SessionSnapshot>()},
                              {"before the first step", scanned(small_scan(), 0)},
                              {"after steps", scanned(small_scan(), 2)},
                              {"refined", scanned(small_scan(), 2, true)},
                              {"finished", scanned(small_scan(), 4)},
                              {"without evaluation", scanned(blind, 2, true)},
                              {"combined", with_gain("combined")},
                              {"random", with_gain("random")},
                              {"one candidate", with_candidates(1)},
                              {"500 candidates", with_candidates(500)},
                              {"failed", failed}};
  }();
  return all;
}

}  // namespace nextview
