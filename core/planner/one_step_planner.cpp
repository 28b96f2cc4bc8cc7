#include <fmt/format.h>

#include <algorithm>

#include "core/planner/planner.hpp"
#include "core/planner/remaining_plan.hpp"
#include "core/planner/termination.hpp"
#include "core/planner/way_text.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/percent_text.hpp"

namespace nextview {
namespace {

PlanningState state_of(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                       const RayCaster& rays) {
  return {setup.config,
          setup.seed,
          setup.occlusion_reach,
          known,
          rays,
          setup.bundle,
          setup.true_surface,
          views,
          known.taken,
          setup.negligible_share,
          setup.fine_bundle};
}

Utility utility(const Policy& policy, const PlanningSetup& setup) {
  if (policy.ignores_cost()) return {{1.0, 0.0}};
  if (setup.config.utility == UtilityKind::gain_per_second) return {setup.config.weights, setup.scan_seconds};
  return {setup.config.weights};
}

/// Ranks them, and values the best two again by finer rays until they stay the best two: what came first by chance
/// does not stay there.
Ranking rank_finely(const Policy& policy, const PlanningState& state, std::span<Candidate> candidates,
                    const Utility& utility, const std::stop_token& stop) {
  std::vector<bool> is_fine(candidates.size());
  while (true) {
    Ranking ranking = rank(candidates, utility);
    if (!ranking.best) return ranking;
    std::vector<std::size_t> again;
    for (const auto v : {ranking.best, runner_up(candidates, *ranking.best)})
      if (v && !is_fine[*v]) again.push_back(*v);
    if (again.empty()) return ranking;
    const std::vector<double> gains = policy.finer_values(state, again, stop);
    throw_if_stopped(stop);
    if (gains.empty()) return ranking;
    for (std::size_t i = 0; i < again.size(); ++i) candidates[again[i]].gain = gains[i], is_fine[again[i]] = true;
  }
}

/// "Candidate 17: 214 cm² of new surface, most of it at its top; 0.9 m away. Runner-up 32: 190 cm², 0.4 m."
std::string reason(const Policy& policy, const PlanningState& state, std::span<const Candidate> candidates,
                   std::size_t best, bool is_per_second) {
  constexpr double saturated = 0.001;  // of the largest gain
  const Candidate& chosen = candidates[best];
  const VoxelGrid& region = state.known.map.grid();
  std::string text = fmt::format("Candidate {}: {}; {} away.", best,
                                 policy.promise(chosen.gain, state, state.candidates[best].T_world_camera),
                                 way_text(chosen.cost, region));
  if (is_per_second) {
    text.back() = ',';
    text += fmt::format(" {} a second.", short_text(chosen.utility, policy.unit()));
  }
  const auto second = runner_up(candidates, best);
  if (!second) return text;
  text +=
      fmt::format(" Runner-up {}: {}, {}.", *second, short_text(candidates[*second].gain, policy.unit(), chosen.gain),
                  way_text(candidates[*second].cost, region));
  double largest = 0.0;
  for (const Candidate& c : candidates)
    if (c.available) largest = std::max(largest, c.gain);
  const auto available = std::ranges::count_if(candidates, &Candidate::available);
  const auto as_good = std::ranges::count_if(
      candidates, [&](const Candidate& c) { return c.available && largest - c.gain <= saturated * largest; });
  if (largest > 0.0 && 2 * as_good > available)
    text += fmt::format(" {} of {} gain the same within 0.1 %: the way there decides.", as_good, available);
  return text;
}

/// " About 12 % of the surface is left: 7 views, 5.12 m." Proven to be the fewest: "7 views (no fewer do), 5.12 m."
/// Where the scan ends before: "7 views, 5.12 m; the limit of 25 views leaves 3." A scan that is to go on to the very
/// last of the surface has views for each of its crumbs: of less than what usually ends a scan they are not told.
std::string outlook(const Valuation& valuation, const PlanningState& state, std::size_t most_views) {
  const std::string left = fmt::format(" About {} of the surface is left", percent_text(*valuation.surface_left));
  const double crumbs = TerminationConfig().surface_left;
  const bool is_of_crumbs = state.negligible_share == 0.0 && *valuation.surface_left < crumbs;
  if (valuation.remaining.empty() || state.taken.empty() || is_of_crumbs) return left + ".";
  std::vector<Vector3> stops;
  for (const std::size_t v : valuation.remaining) stops.push_back(state.candidates[v].T_world_camera.translation());
  const std::size_t count = stops.size();
  const char* fewest = valuation.remaining_is_fewest && count > 1 ? " (no fewer do)" : "";
  const std::size_t open = most_views - std::min(most_views, state.taken.size());
  const std::string limit = open > 0 && open < count ? fmt::format("; the limit of {} view{} leaves {}", most_views,
                                                                   most_views == 1 ? "" : "s", open)
                                                     : "";
  return left + fmt::format(": {} view{}{}, {}{}.", count, count == 1 ? "" : "s", fewest,
                            way_text(short_way(state.taken.back().T_world_camera.translation(), std::move(stops)),
                                     state.known.map.grid()),
                            limit);
}

/// What it changed that scans are to be registered; empty if nothing.
std::string for_overlap(std::span<const Candidate> candidates, std::size_t best) {
  if (!candidates[best].overlaps) return " No candidate shows enough of what was scanned to be registered with it.";
  const auto passed_over = std::ranges::count_if(candidates, [&](const Candidate& c) {
    return c.available && !c.overlaps && c.utility > candidates[best].utility;
  });
  if (passed_over == 0) return "";
  return fmt::format(" {} better, but would show too little of what was scanned to be registered with it.",
                     passed_over == 1 ? "One candidate is" : fmt::format("{} candidates are", passed_over));
}

}  // namespace

Plan OneStepPlanner::plan(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                          std::vector<Candidate> candidates, std::stop_token stop) const {
  std::vector<std::size_t> available;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) available.push_back(v);
  const auto rays = planning_rays(known, setup.config.ray_length);
  PlanningState state = state_of(setup, known, views, *rays);
  const Valuation valuation = policy_->values(state, available, stop);
  throw_if_stopped(stop);  // or the ranking would be half one
  state.surface_left = valuation.surface_left;
  for (std::size_t i = 0; i < available.size(); ++i) candidates[available[i]].gain = valuation.gains[i];
  if (policy_->ignores_cost())
    for (Candidate& candidate : candidates) candidate.overlaps = true;
  const Utility by = utility(*policy_, setup);
  Ranking ranking = rank_finely(*policy_, state, candidates, by, stop);
  if (ranking.best) {
    const Choice choice = choose(state, candidates, by, *ranking.best, stop);
    ranking.best = choice.candidate;
    ranking.reason = reason(*policy_, state, candidates, choice.candidate, by.scan_seconds.has_value());
    ranking.reason += choice.because + for_overlap(candidates, choice.candidate);
  }
  if (ranking.best && valuation.surface_left) ranking.reason += outlook(valuation, state, setup.most_views);
  return {std::move(candidates), std::move(ranking), valuation.surface_left};
}

std::optional<ScoreExplanation> OneStepPlanner::explain(const PlanningSetup& setup, const Knowledge& known,
                                                        const Pose& T_world_camera,
                                                        std::optional<double> surface_left) const {
  const auto rays = planning_rays(known, setup.config.ray_length);
  PlanningState state = state_of(setup, known, {}, *rays);
  state.surface_left = surface_left;
  return policy_->explain(state, T_world_camera);
}

}  // namespace nextview
