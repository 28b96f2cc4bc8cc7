#include "core/planner/gain_policies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace nextview {
namespace {

/// The value of each available candidate by each gain, from one cast of the rays.
std::vector<std::vector<double>> gain_values(const PlanningState& state, std::span<const std::size_t> available,
                                             std::span<const Gain* const> gains, std::stop_token stop) {
  std::vector<Pose> views;
  for (const std::size_t v : available) views.push_back(state.candidates[v].T_world_camera);
  const auto scores =
      score_views(state.caster, views, state.bundle, gains, {state.config.semantics, state.occlusion_reach}, stop);
  std::vector<std::vector<double>> values(gains.size());
  for (std::size_t g = 0; g < gains.size(); ++g)
    for (const ViewScore& score : scores) values[g].push_back(score.gains.empty() ? 0.0 : score.gains[g]);
  return values;
}

}  // namespace

Valuation GainPolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                             std::stop_token stop) const {
  const Gain* const one = &gain_;
  return gain_values(state, available, {&one, 1}, stop).front();
}

std::optional<ScoreExplanation> GainPolicy::explain(const PlanningState& state, const Pose& T_world_camera) const {
  return explain_score(state.caster, T_world_camera, state.bundle, gain_,
                       {state.config.semantics, state.occlusion_reach});
}

CombinedPolicy::CombinedPolicy(const std::string& weights) {
  if (weights.empty())
    for (const WeightedGain& w : prerelease_weights()) {
      gains_.push_back(&nextview::gain(w.name));
      weights_.push_back(w.weight);
    }
  std::istringstream parts(weights);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto equals = part.find('=');
    char* end = nullptr;
    const double weight = equals == std::string::npos ? NAN : std::strtod(part.c_str() + equals + 1, &end);
    if (!std::isfinite(weight) || *end != '\0' || end == part.c_str() + equals + 1)
      throw std::invalid_argument(
          fmt::format("planner.combined_weights takes `gain=weight,gain=weight`, not '{}'", part));
    try {
      gains_.push_back(&nextview::gain(part.substr(0, equals)));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("planner.combined_weights: {}", error.what()));
    }
    weights_.push_back(weight);
  }
}

PolicyNeeds CombinedPolicy::needs() const {
  return {std::ranges::any_of(gains_, &Gain::needs_occlusion), std::ranges::any_of(gains_, &Gain::needs_posterior),
          false};
}

Valuation CombinedPolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                 std::stop_token stop) const {
  return combine(weights_, gain_values(state, available, gains_, stop), state.config.semantics);
}

}  // namespace nextview
