#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/planner/rank_correlation.hpp"
#include "core/planner/scan_overlap.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"
#include "core/session/scan_loop.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

/// Times the least overlap that registration asks for: scans of three objects had from a half to all of what the map
/// expected.
constexpr double overlap_margin = 4.0;

/// The true surface as the views so far have seen it: that of a known object, or what a recording's frames show.
template <class Surface>
class SurfaceLeft : public TrueSurface {
 public:
  SurfaceLeft(const Surface& surface, std::vector<std::uint8_t> seen) : surface_(surface), seen_(std::move(seen)) {}
  std::size_t new_samples(std::size_t candidate) const override {
    return std::size_t(std::ranges::count_if(surface_.seen_from(candidate), [&](auto s) { return !seen_[s]; }));
  }
  std::vector<std::uint32_t> unseen_samples(std::size_t candidate) const override {
    std::vector<std::uint32_t> unseen;
    std::ranges::copy_if(surface_.seen_from(candidate), std::back_inserter(unseen), [&](auto s) { return !seen_[s]; });
    return unseen;
  }
  std::size_t visible_samples() const override { return surface_.visible_samples(); }
  std::vector<std::size_t> covering_order(std::uint64_t seed) const override { return surface_.covering_order(seed); }

 private:
  const Surface& surface_;
  std::vector<std::uint8_t> seen_;
};

/// What a planner is given besides the knowledge; valid as long as the setup and the state are.
struct PlanningInput {
  /// @throws Stopped
  PlanningInput(const ScanSetup& scan, const ScanState& state, const std::stop_token& stop = {})
      : setup{scan.configuration.planner,
              scan.configuration.seed,
              occlusion_reach(scan.configuration),
              scan.configuration.sensor.seconds,
              scan.bundle,
              nullptr,
              scan.configuration.termination.surface_left,
              scan.fine_bundle.directions.empty() ? nullptr : &scan.fine_bundle,
              std::size_t(scan.configuration.termination.views)} {
    if (!scan.planner->needs().true_surface) return;
    if (scan.recorded)
      surface = std::make_unique<SurfaceLeft<RecordedSurface>>(*scan.recorded,
                                                               scan.recorded->seen(frames_taken(state.known)));
    else if (state.evaluation)
      surface = std::make_unique<SurfaceLeft<CandidateSight>>(scan.sight ? *scan.sight : scan.truth->sight({}, stop),
                                                              state.evaluation->seen);
    setup.true_surface = surface.get();
  }
  PlanningInput(const PlanningInput&) = delete;

  std::unique_ptr<TrueSurface> surface;
  PlanningSetup setup;
};

/// The candidates with what the robot says of them. Views that were taken are not available.
std::vector<Candidate> reachable_candidates(const ScanState& state, std::span<const Reach> reach) {
  const std::vector<View>& views = state.candidates;
  std::vector<Candidate> candidates(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    candidates[v].cost = reach[v].cost.distance;
    candidates[v].seconds = reach[v].cost.seconds;
    candidates[v].unreachable = reach[v].unreachable;
    candidates[v].available = reach[v].unreachable.empty() && !state.known.has_taken(views[v]);
  }
  return candidates;
}

/// A scan with too little of what was scanned before cannot be registered, and later ones would be registered with it.
void ask_for_overlap(const ScanSetup& setup, const ScanState& state, std::vector<Candidate>& candidates,
                     const std::stop_token& stop) {
  const auto rays = planning_rays(state.known, setup.configuration.planner.ray_length);
  const std::vector<double> overlap = scan_overlap(state.known, *rays, setup.bundle, state.candidates, stop);
  const double least = overlap_margin * setup.configuration.registration.min_overlap;
  for (std::size_t v = 0; v < candidates.size(); ++v) candidates[v].overlaps = overlap[v] >= least;
}

/// What the same planner would have made of the conventional map. Nothing where that is the one it plans on: the
/// planner is another one now than when the view was refined.
void compare_with_conventional(const ScanSetup& setup, const ScanState& state, const PlanningInput& input,
                               std::vector<Candidate> candidates, StepRecord& record, const std::stop_token& stop) {
  RefinementRecord& refinement = *record.refinement;
  refinement.conventional_gains.clear(), refinement.conventional_best.reset(), refinement.rank_correlation = 0.0;
  if (!state.known.posterior) return;
  Knowledge conventional = state.known;
  conventional.posterior = nullptr;
  const Plan plan = setup.planner->plan(input.setup, conventional, state.candidates, std::move(candidates), stop);
  std::vector<double> refined_gains, conventional_gains;
  refinement.conventional_gains.assign(plan.candidates.size(), 0.0);
  for (std::size_t v = 0; v < plan.candidates.size(); ++v) {
    if (!plan.candidates[v].available) continue;
    refinement.conventional_gains[v] = plan.candidates[v].gain;
    conventional_gains.push_back(plan.candidates[v].gain);
    refined_gains.push_back(record.candidates[v].gain);
  }
  refinement.rank_correlation = rank_correlation(refined_gains, conventional_gains);
  refinement.conventional_best = plan.ranking.best;
}

double best_gain(const StepRecord& record) {
  double best = 0.0;
  for (const Candidate& c : record.candidates)
    if (c.available) best = std::max(best, c.gain);
  return best;
}

}  // namespace

void choose_rays(ScanSetup& setup) {
  setup.bundle = scoring_rays(setup.configuration, setup.source.camera);
  setup.fine_bundle = finer_rays(setup.configuration, setup.source.camera);
}

std::vector<Reach> reach_of(const StepRecord& record) {
  std::vector<Reach> reach;
  for (const Candidate& c : record.candidates) reach.push_back({c.unreachable, {c.cost, 0.0, c.seconds}});
  return reach;
}

ScanState plan(const ScanSetup& setup, ScanState state, Robot& robot, std::span<const Reach> reach,
               const Progress& progress, const std::stop_token& stop) {
  if (progress) progress(0.7, "scoring the candidate views");
  throw_if_stopped(stop);
  auto record = std::make_shared<StepRecord>(*state.records.back());
  {
    Stopwatch watch(record->seconds.score);
    state.candidates = setup.candidates->candidates(state.known);
    const bool is_said = reach.size() == state.candidates.size();
    auto candidates = reachable_candidates(state, is_said ? reach : robot.reach(robot.pose(), state.candidates));
    if (setup.configuration.registration.mode == RegistrationConfig::Mode::correct)
      ask_for_overlap(setup, state, candidates, stop);
    const PlanningInput input(setup, state, stop);
    Plan plan = setup.planner->plan(input.setup, state.known, state.candidates, candidates, stop);
    record->candidates = std::move(plan.candidates);
    record->ranking = std::move(plan.ranking);
    record->ranking.gain_unit = setup.planner->unit();
    record->surface_left = plan.surface_left;
    if (record->refinement) compare_with_conventional(setup, state, input, candidates, *record, stop);
  }
  state.records.back() = std::move(record);
  state.next = proposal(setup, state);                                   // p <- next best view
  state.finished = termination(setup.configuration.termination, state);  // if p meets the terminal criterion, finish
  return state;
}

NextView proposal(const ScanSetup& setup, const ScanState& state) {
  const StepRecord& record = *state.records.back();
  const auto best = record.ranking.best;
  if (!best) return {setup.start};
  const Candidate& c = record.candidates[*best];
  return {state.candidates[*best], best, false, false, c.gain, c.utility, record.ranking.gain_unit};
}

std::string termination(const TerminationConfig& config, const ScanState& state) {
  const StepRecord& last = *state.records.back();
  ScanProgress progress;
  progress.views = static_cast<int>(state.records.size());
  progress.coverage = last.coverage_recorded.value_or(last.coverage_visible);
  progress.candidates_left = last.ranking.best.has_value();
  progress.surface_left = last.surface_left;
  progress.best_gain = best_gain(last);
  progress.first_gain = best_gain(*state.records.front());
  progress.new_voxel_share = double(last.new_voxels) / double(state.known.map.voxels().size());
  if (state.records.size() > 1)
    progress.entropy_drop_share = 1.0 - last.entropy / state.records[state.records.size() - 2]->entropy;
  const auto unreachable = std::ranges::find_if(last.candidates, [&](const Candidate& candidate) {
    return !progress.candidates_left && !candidate.unreachable.empty();
  });
  std::string reason = termination_reason(config, progress);
  if (unreachable == last.candidates.end() || progress.views >= config.views) return reason;
  return fmt::format("{} that can be reached: {}", reason, unreachable->unreachable);
}

std::optional<ScoreExplanation> explain(const ScanSetup& setup, const ScanState& state, const Pose& T_world_camera) {
  const PlanningInput input(setup, state);
  const auto surface_left = state.records.empty() ? std::nullopt : state.records.back()->surface_left;
  return setup.planner->explain(input.setup, state.known, T_world_camera, surface_left);
}

}  // namespace nextview
