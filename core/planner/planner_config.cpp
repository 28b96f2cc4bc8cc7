#include "core/planner/planner_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/planner/gain_policies.hpp"

namespace nextview {
namespace {

Setting::Choice gain_choice(std::string& gain) {
  return {policy_names(),
          [&gain] {
            const auto names = policy_names();
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), gain) - names.begin());
          },
          [&gain](std::size_t i) { gain = policy_names()[i]; }};
}

}  // namespace

std::vector<Setting> settings(PlannerConfig& c) {
  std::vector<Setting> all = {
      {"planner.gain", "", "what ranks the candidate views", gain_choice(c.gain)},
      {"planner.semantics", "", "published, or what the reference code computes",
       choice(c.semantics, {"published", "reference"})},
      {"planner.utility", "",
       "weighted-shares (Eq. 13), or gain-per-second of the robot's way and of a scan (sensor.seconds)",
       choice(c.utility, {"weighted-shares", "gain-per-second"})},
      {"planner.gain_weight", "", "weight of the gain in the utility (Eq. 13)", &c.weights.gain, from_to(0, 1e6)},
      {"planner.cost_weight", "", "weight of the distance in the utility (Eq. 13)", &c.weights.cost, from_to(0, 1e6)},
      {"planner.combined_weights", "", "gain=weight,…; empty: the pre-release weights, unconfirmed",
       &c.combined_weights},
      {"planner.ray_columns", "", "rays that score a view, across", &c.ray_columns, from_to(1, 2000)},
      {"planner.ray_rows", "", "rays that score a view, down", &c.ray_rows, from_to(1, 2000)},
      {"planner.ray_refinement", "",
       "times as many rays each way, up to one a pixel, that score the best two views again (new-surface only); 1: "
       "none",
       &c.ray_refinement, from_to(1, 16)},
      {"planner.ray_window", "", "share of the image's width and height that they go through, about its middle",
       &c.ray_window, over_to(0, 1)},
      {"planner.ray_length", "m", "how far they reach", &c.ray_length, from_to(1e-3, 1000)},
      {"planner.simulations", "",
       "plans of several views tried out in drawn worlds (new-surface only); 0: no look-ahead", &c.simulations,
       from_to(0, 100000)},
      {"planner.start_azimuth", "deg", "start view, seen from the object", &c.start_azimuth, from_to(-360, 360)},
      {"planner.start_elevation", "deg", "start view, seen from the object", &c.start_elevation, from_to(-90, 90)},
      {"planner.start_view", "", "start view as x y z qx qy qz qw; empty: from azimuth and elevation", &c.start_view},
  };
  std::ranges::move(settings(c.new_surface), std::back_inserter(all));
  return all;
}

void PlannerConfig::validate() const {
  require_in_bounds(*this);
  const auto names = policy_names();
  if (std::find(names.begin(), names.end(), gain) == names.end())
    throw std::invalid_argument(
        fmt::format("planner.gain: there is no gain '{}'{}", gain,
                    did_you_mean(gain, names, fmt::format("; it is one of {}", fmt::join(names, ", ")))));
  if (make_policy(*this)->needs().posterior && semantics != Semantics::published)
    throw std::invalid_argument(
        fmt::format("planner.gain {} needs planner.semantics published: the reference code knows no Gibbs map", gain));
  if (simulations > 0 && gain != "new-surface")
    throw std::invalid_argument(fmt::format("planner.simulations needs planner.gain new-surface; it is {}", gain));
  const CombinedPolicy readable(combined_weights);
  if (start_view.empty()) return;
  try {
    parse_view(start_view);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("planner.start_view, '{}': {}", start_view, error.what()));
  }
}

}  // namespace nextview
