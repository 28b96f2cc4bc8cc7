#include "core/offline/session_scores.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/planner/policy.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {

namespace {

/// Where a session stands, and what ranked its candidates there.
struct Stand {
  ScanState state;
  PlannerConfig planner;
};

}  // namespace

SceneScores score_session(Session& session, std::span<const std::string> names, const Progress& progress,
                          const std::stop_token& stop) {
  if (session.records().empty()) throw std::invalid_argument(session.name() + ": no view was taken yet");
  const Stand own{session.state(), session.configuration().planner};
  std::optional<Stand> refined;  // the Gibbs map is made once, for all gains of it
  SceneScores scores;
  scores.views.resize(session.candidates().size());
  for (ViewScore& view : scores.views) view.rays = session.setup().bundle.directions.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    PlannerConfig planner = own.planner;
    planner.gain = names[k];
    const bool of_gibbs_map = make_policy(planner)->needs().posterior;
    const Stand& from = of_gibbs_map && refined ? *refined : own;
    session.restore(from.state, {from.planner, session.configuration().views, session.configuration().gibbs});
    double seconds = 0.0;
    if (names[k] != from.planner.gain) {
      const Stopwatch watch(seconds);
      const double begin = double(k) / double(names.size()), end = double(k + 1) / double(names.size());
      session.set_planner(planner, part(progress, begin, end), stop);
    }
    throw_if_stopped(stop);
    if (of_gibbs_map && !refined) refined = {session.state(), planner};
    scores.gains.push_back(names[k]);
    const std::vector<Candidate>& candidates = session.records().back().candidates;
    if (candidates.size() != scores.views.size())  // they may be made from the map, and the Gibbs map is another one
      throw std::invalid_argument(names[k] + ": has candidate views of its own; score by it alone");
    for (std::size_t v = 0; v < scores.views.size(); ++v) {
      scores.views[v].gains.push_back(candidates[v].available ? candidates[v].gain : std::nan(""));
      scores.views[v].milliseconds += 1e3 * seconds / double(scores.views.size());
    }
  }
  session.restore(own.state, {own.planner, session.configuration().views, session.configuration().gibbs});
  return scores;
}

}  // namespace nextview
