#pragma once
#include "core/gain/drawn_worlds.hpp"
#include "core/planner/planner.hpp"

namespace nextview {

/// Views that can be taken one after the other, and what they would show.
struct ViewTree {
  std::vector<DrawnWorld> worlds;           ///< each with all the views
  std::vector<double> gains;                ///< of each view as the next one [cm^2]
  std::vector<std::vector<double>> prices;  ///< [from][to], each at least 0; the last row is from where the camera is
  std::vector<std::vector<double>> ways;    ///< the same [m]
  std::size_t depth = 6;                    ///< views of a sequence
  double kept = 0.85;                       ///< of what is shown, for each unit of price before
  std::size_t ranked = 0;                   ///< the view that is best as the next one, one step ahead
};

/// Views one after the other. What one shows is worth less by a constant share for each unit of price up to it.
struct ViewSequence {
  std::vector<std::size_t> views;
  double value = 0.0;
  double area = 0.0;  ///< expected new surface of all of them [cm^2]
  double way = 0.0;   ///< [m]
};

struct LookAhead {
  ViewSequence best;
  ViewSequence of_ranked;  ///< the best that begins with ViewTree::ranked
};

/// Monte Carlo tree search (UCT) for the most valuable sequence: so many are tried out, each in all the worlds. A
/// tree's node is a fork of what is seen in each of them. @pre there are a view, a world and a simulation @throws
/// Stopped
LookAhead look_ahead(const ViewTree& tree, int simulations, const std::stop_token& stop = {});

/// Ranks views by expected new surface and the way there, then takes the one that begins the best sequence.
class LookAheadPlanner : public OneStepPlanner {
 public:
  LookAheadPlanner(std::unique_ptr<const Policy> policy, const NewSurfaceModel& model, int simulations)
      : OneStepPlanner(std::move(policy)), model_(model), simulations_(simulations) {}

 private:
  Choice choose(const PlanningState& state, std::span<const Candidate> candidates, const Utility& utility,
                std::size_t ranked, const std::stop_token& stop) const override;

  NewSurfaceModel model_;
  int simulations_;
};

/// As planner.gain and planner.simulations say. @throws std::invalid_argument as make_policy
std::unique_ptr<Planner> make_planner(const PlannerConfig& config);

}  // namespace nextview
