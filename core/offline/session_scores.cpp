#include "core/offline/session_scores.hpp"

#include <cmath>
#include <stdexcept>

#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {

SceneScores score_session(Session& session, std::span<const std::string> names, const Progress& progress,
                          const std::stop_token& stop) {
  if (session.records().empty()) throw std::invalid_argument(session.name() + ": no view was taken yet");
  const PlannerConfig own = session.configuration().planner;
  const ScanState as_it_stands = session.state();
  SceneScores scores;
  scores.views.resize(session.candidates().size());
  for (ViewScore& view : scores.views) view.rays = session.setup().bundle.directions.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    PlannerConfig planner = own;
    planner.gain = names[k];
    double seconds = 0.0;
    if (names[k] != own.gain) {
      const Stopwatch watch(seconds);
      const double begin = double(k) / double(names.size()), end = double(k + 1) / double(names.size());
      session.set_planner(planner, part(progress, begin, end), stop);
    }
    throw_if_stopped(stop);
    scores.gains.push_back(names[k]);
    const std::vector<Candidate>& candidates = session.records().back().candidates;
    if (candidates.size() != scores.views.size())  // they may be made from the map, and the Gibbs map is another one
      throw std::invalid_argument(names[k] + ": has candidate views of its own; score by it alone");
    for (std::size_t v = 0; v < scores.views.size(); ++v) {
      scores.views[v].gains.push_back(candidates[v].available ? candidates[v].gain : std::nan(""));
      scores.views[v].milliseconds += 1e3 * seconds / double(scores.views.size());
    }
    session.restore(as_it_stands, {own, session.configuration().views});
  }
  return scores;
}

}  // namespace nextview
