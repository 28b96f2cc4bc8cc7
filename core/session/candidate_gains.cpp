#include "core/session/candidate_gains.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

/// How far behind a surface voxels are marked as occluded [m] (Isler et al. 2016).
constexpr double occlusion_distance = 0.3;

std::vector<std::vector<double>> volumetric_gains(const PlanningState& state, std::span<const std::size_t> available,
                                                  std::span<const Gain* const> gains, std::stop_token stop) {
  std::vector<Pose> views;
  for (const std::size_t v : available) views.push_back(state.candidates[v]);
  const ScoreOptions options{state.configuration.planner.semantics, occlusion_reach(state.configuration)};
  const auto scores = score_views(state.caster, views, state.bundle, gains, options, stop);
  std::vector<std::vector<double>> values(gains.size());
  for (std::size_t g = 0; g < gains.size(); ++g)
    for (const ViewScore& score : scores) values[g].push_back(score.gains.empty() ? 0.0 : score.gains[g]);
  return values;
}

double distance_to_nearest(const Pose& view, std::span<const Pose> taken) {
  double nearest = std::numeric_limits<double>::max();
  for (const Pose& t : taken) nearest = std::min(nearest, (t.translation() - view.translation()).norm());
  return taken.empty() ? 0.0 : nearest;
}

double baseline_gain(const PlanningState& state, const std::string& name, std::size_t candidate,
                     std::span<const std::size_t> covering_order) {
  const auto count = static_cast<double>(state.candidates.size());
  if (name == "random")
    return CounterRandom(state.configuration.seed, random_stream::random_planner,
                         static_cast<std::uint32_t>(state.taken.size()))
        .uniform(candidate)[0];
  if (name == "farthest") return distance_to_nearest(state.candidates[candidate], state.taken);
  if (name == "fixed-order") return count - static_cast<double>(candidate);
  if (name == "oracle") return static_cast<double>(state.known_object->new_samples(candidate));
  const auto place = std::find(covering_order.begin(), covering_order.end(), candidate) - covering_order.begin();
  return count - static_cast<double>(place);
}

}  // namespace

std::vector<double> candidate_gains(const PlanningState& state, std::span<const std::size_t> available,
                                    std::stop_token stop) {
  const PlannerConfig& planner = state.configuration.planner;
  if (is_baseline(planner.gain)) {
    if (!state.known_object && (planner.gain == "oracle" || planner.gain == "covering-order"))
      throw std::invalid_argument("planner.gain " + planner.gain + " knows the mesh: it needs evaluation.enabled");
    const auto order = planner.gain == "covering-order" ? state.known_object->covering_order(state.configuration.seed)
                                                        : std::vector<std::size_t>{};
    std::vector<double> values;
    for (const std::size_t v : available) values.push_back(baseline_gain(state, planner.gain, v, order));
    return values;
  }
  if (planner.gain == "combined") {
    std::vector<const Gain*> parts;
    std::vector<double> weights;
    for (const auto& [name, weight] : parse_combined_weights(planner.combined_weights)) {
      parts.push_back(&gain(name));
      weights.push_back(weight);
    }
    return combine(weights, volumetric_gains(state, available, parts, stop), planner.semantics);
  }
  const Gain* one = &gain(planner.gain);
  return volumetric_gains(state, available, std::span(&one, 1), stop).front();
}

std::string gain_unit(const std::string& name) {
  if (name == "farthest") return "m";
  if (name == "oracle") return "samples";
  if (name == "combined" || is_baseline(name)) return "";
  return std::string(gain(name).unit);
}

double occlusion_reach(const Configuration& configuration) {
  return 2.0 * occlusion_distance / configuration.map.resolution;
}

bool needs_occlusion(const Configuration& configuration) {
  const std::string& name = configuration.planner.gain;
  if (is_baseline(name)) return false;
  if (name != "combined") return gain(name).needs_occlusion;
  const auto parts = parse_combined_weights(configuration.planner.combined_weights);
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return gain(part.first).needs_occlusion; });
}

}  // namespace nextview
