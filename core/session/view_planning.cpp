#include "core/session/view_planning.hpp"

#include <algorithm>

#include "core/planner/rank_correlation.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

std::vector<std::size_t> available(std::span<const Candidate> candidates) {
  std::vector<std::size_t> numbers;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) numbers.push_back(v);
  return numbers;
}

double best_gain(const StepRecord& record) {
  double best = 0.0;
  for (const Candidate& c : record.candidates)
    if (c.available) best = std::max(best, c.gain);
  return best;
}

}  // namespace

void rank_candidates(const Policy& policy, const PlanningState& state, const Robot& robot,
                     const std::vector<bool>& visited, StepRecord& record, const std::stop_token& stop) {
  record.candidates.assign(state.candidates.size(), {});
  for (std::size_t v = 0; v < record.candidates.size(); ++v) {
    Candidate& c = record.candidates[v];
    c.cost = robot.cost(robot.pose(), state.candidates[v]).distance;
    c.available = !visited[v] && !robot.unreachable(state.candidates[v]);
  }
  const auto left = available(record.candidates);
  const auto gains = policy.values(state, left, stop);
  throw_if_stopped(stop);  // or the ranking would be half one
  for (std::size_t i = 0; i < left.size(); ++i) record.candidates[left[i]].gain = gains[i];
  record.ranking = rank(record.candidates, policy.weights(state.config));
}

void compare_rankings(const Policy& policy, const PlanningState& conventional, StepRecord& record,
                      const std::stop_token& stop) {
  const auto left = available(record.candidates);
  const auto gains = policy.values(conventional, left, stop);
  throw_if_stopped(stop);
  auto candidates = record.candidates;
  std::vector<double> refined;
  RefinementRecord& refinement = *record.refinement;
  refinement.conventional_gains.assign(candidates.size(), 0.0);
  for (std::size_t i = 0; i < left.size(); ++i) {
    refined.push_back(candidates[left[i]].gain);
    candidates[left[i]].gain = refinement.conventional_gains[left[i]] = gains[i];
  }
  refinement.rank_correlation = rank_correlation(refined, gains);
  refinement.conventional_best = rank(candidates, policy.weights(conventional.config)).best;
}

std::string termination(const TerminationConfig& config, std::span<const StepRecord> records, std::size_t voxels) {
  const StepRecord& last = records.back();
  ScanProgress progress;
  progress.views = static_cast<int>(records.size());
  progress.coverage = last.coverage_visible;
  progress.candidates_left = last.ranking.best.has_value();
  progress.best_gain = best_gain(last);
  progress.first_gain = best_gain(records.front());
  progress.new_voxel_share = double(last.new_voxels) / double(voxels);
  if (records.size() > 1) progress.entropy_drop_share = 1.0 - last.entropy / records[records.size() - 2].entropy;
  return termination_reason(config, progress);
}

}  // namespace nextview
