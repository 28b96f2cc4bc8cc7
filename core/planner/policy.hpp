#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/gain/view_score.hpp"
#include "core/planner/knowledge.hpp"
#include "core/planner/planner_config.hpp"

namespace nextview {

/// What has to be kept for a policy while a scan runs.
struct PolicyNeeds {
  bool occlusions = false;  ///< how far voxels lie behind a surface (OccupancyMap::mark_occlusions)
  bool posterior = false;   ///< the Gibbs map, refined after each view; published semantics only
  bool true_surface = false;
};

/// The true surface of a simulated scan, for the baselines that may look at it.
class TrueSurface {
 public:
  virtual ~TrueSurface() = default;
  /// How many surface samples the candidate would see that no view has seen yet.
  virtual std::size_t new_samples(std::size_t candidate) const = 0;
  /// Which they are.
  virtual std::vector<std::uint32_t> unseen_samples(std::size_t candidate) const = 0;
  /// How many any candidate would see, seen by now or not.
  virtual std::size_t visible_samples() const = 0;
  /// The candidates in the order of a greedy set cover of the samples, the cover's own views shuffled, then the others.
  virtual std::vector<std::size_t> covering_order(std::uint64_t seed) const = 0;
};

/// What the candidate views are valued on.
struct PlanningState {
  const PlannerConfig& config;
  std::uint64_t seed;
  double occlusion_reach;  ///< d_max of proximity count [voxels]
  const Knowledge& known;
  const RayCaster& caster;  ///< through what is known
  const RayBundle& bundle;
  const TrueSurface* true_surface;  ///< null where it is not known, or not evaluated
  std::span<const View> candidates;
  std::span<const TakenView> taken;        ///< so far, in order
  double negligible_share = 0.005;         ///< of the surface: for less no view is worth it (termination.surface_left)
  const RayBundle* fine_bundle = nullptr;  ///< PlanningSetup::fine_bundle
  /// Valuation::surface_left of all that can be taken; none before they are valued.
  std::optional<double> surface_left = {};
};

/// What a policy makes of some candidates.
struct Valuation {
  Valuation(std::vector<double> values) : gains(std::move(values)) {}
  Valuation(std::vector<double> values, std::optional<double> left, std::vector<std::size_t> few = {},
            bool is_fewest = false)
      : gains(std::move(values)), surface_left(left), remaining(std::move(few)), remaining_is_fewest(is_fewest) {}

  std::vector<double> gains;           ///< one a candidate
  std::optional<double> surface_left;  ///< share of all surface that they are expected to show; none: not predicted
  std::vector<std::size_t> remaining;  ///< of the candidates, by number: few that are expected to show it
  bool remaining_is_fewest = false;    ///< proven: no fewer would
};

/// What a view is worth: a volumetric information, or a baseline that stands for one. The utility weighs it against the
/// way.
class Policy {
 public:
  virtual ~Policy() = default;
  /// Of its values, for people: "nats", "voxels", "m", "samples", or "" if they have none.
  virtual std::string unit() const { return ""; }
  virtual PolicyNeeds needs() const { return {}; }
  /// Whether neither the way there nor registration has a say, as in a baseline, which is a policy of its own.
  virtual bool ignores_cost() const { return false; }
  /// The value of each candidate in `available`. A requested stop leaves what is not valued yet at 0.
  virtual Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                           std::stop_token stop) const = 0;
  /// Those of some candidates by finer rays than values() has; empty if there are none.
  virtual std::vector<double> finer_values(const PlanningState&, std::span<const std::size_t> /*candidates*/,
                                           std::stop_token) const {
    return {};
  }
  /// The gain that its value of a single view is, whose rays then explain it; null if it is none.
  virtual const Gain* gain() const { return nullptr; }
  /// What a view of this value promises, for people: "gain 12.5 nats", "214 cm² of new surface, most of it at the top".
  virtual std::string promise(double value, const PlanningState& state, const Pose& T_world_camera) const;
  /// Why no rays explain it, to be read behind its name; empty if they do.
  virtual std::string no_explanation() const { return "ranks views without rays"; }
  /// Why a view would have its value, by finer rays if there are any; nothing if no rays explain it.
  virtual std::optional<ScoreExplanation> explain(const PlanningState&, const Pose&) const { return std::nullopt; }
};

/// "214", "12.5", "0.083": three digits, and whole numbers in full.
std::string short_text(double value);
/// The same with its unit: "12.5 nats"; areas in the unit that suits them, or what they stand beside, however the
/// policy has them.
std::string short_text(double value, const std::string& unit, double beside);
inline std::string short_text(double value, const std::string& unit) { return short_text(value, unit, value); }

/// A policy as it is offered.
struct PolicyEntry {
  std::string name;                                                   ///< what `planner.gain` takes
  std::string summary;                                                ///< one line for people
  bool baseline;                                                      ///< there to be compared with
  std::function<std::unique_ptr<Policy>(const PlannerConfig&)> make;  ///< @throws std::invalid_argument
};

/// Every policy there is: the gains, their combination, the baselines. A new one is a file and a line in policy.cpp.
std::span<const PolicyEntry> policies();
std::vector<std::string> policy_names();
/// @throws std::invalid_argument naming the known ones.
const PolicyEntry& policy_entry(const std::string& name);
/// @throws std::invalid_argument for an unknown name, or settings that the policy cannot do with.
std::unique_ptr<Policy> make_policy(const PlannerConfig& config);

}  // namespace nextview
