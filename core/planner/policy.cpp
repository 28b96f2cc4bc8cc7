#include "core/planner/policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/planner/baseline_policies.hpp"
#include "core/planner/gain_policies.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/planner/surface_edge_policy.hpp"
#include "core/setting/area_text.hpp"

namespace nextview {
namespace {

template <class P>
std::unique_ptr<Policy> make(const PlannerConfig&) {
  return std::make_unique<P>();
}

std::vector<PolicyEntry> all_policies() {
  std::vector<PolicyEntry> all;
  all.push_back({"new-surface", "the surface that a view is expected to see first, learned from simulated scans", false,
                 [](const PlannerConfig& c) { return std::make_unique<NewSurfacePolicy>(c.new_surface); }});
  all.push_back({"new-surface-gibbs", "as new-surface, of the Gibbs map", false,
                 [](const PlannerConfig& c) { return std::make_unique<NewSurfacePolicy>(c.new_surface, true); }});
  for (const Gain& gain : gains())
    all.push_back({std::string(gain.name), std::string(gain.summary), false,
                   [&gain](const PlannerConfig&) { return std::make_unique<GainPolicy>(gain); }});
  all.push_back({"combined", "several gains, weighed (Isler et al. 2016)", false,
                 [](const PlannerConfig& c) { return std::make_unique<CombinedPolicy>(c.combined_weights); }});
  all.push_back({"random", "any candidate, drawn by the seed", true, make<RandomPolicy>});
  all.push_back({"farthest", "the candidate farthest from the views taken", true, make<FarthestPolicy>});
  all.push_back({"fixed-order", "the candidates in the order of their numbers", true, make<FixedOrderPolicy>});
  all.push_back(
      {"covering-order", "a greedy set cover of the true surface, shuffled", true, make<CoveringOrderPolicy>});
  all.push_back(
      {"set-cover", "a least set of candidates that see 99 % of the true surface", true, make<SetCoverPolicy>});
  all.push_back({"surface-edge-density", "the points around which few have been measured that a view sees", true,
                 make<SurfaceEdgePolicy>});
  all.push_back({"oracle", "the candidate that really sees most new surface", true, make<OraclePolicy>});
  return all;
}

}  // namespace

std::string short_text(double value) {
  return std::abs(value) >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string short_text(double value, const std::string& unit, double beside) {
  if (unit == "cm²") return area_text(value, beside);
  return unit.empty() ? short_text(value) : fmt::format("{} {}", short_text(value), unit);
}

std::string Policy::promise(double value, const PlanningState&, const Pose&) const {
  return "gain " + short_text(value, unit());
}

std::span<const PolicyEntry> policies() {
  static const std::vector<PolicyEntry> all = all_policies();
  return all;
}

std::vector<std::string> policy_names() {
  std::vector<std::string> names;
  for (const PolicyEntry& policy : policies()) names.push_back(policy.name);
  return names;
}

const PolicyEntry& policy_entry(const std::string& name) {
  const auto found = std::ranges::find(policies(), name, &PolicyEntry::name);
  if (found == policies().end())
    throw std::invalid_argument(
        fmt::format("there is no gain '{}'; there are {}", name, fmt::join(policy_names(), ", ")));
  return *found;
}

std::unique_ptr<Policy> make_policy(const PlannerConfig& config) { return policy_entry(config.gain).make(config); }

}  // namespace nextview
