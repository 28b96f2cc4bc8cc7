#pragma once
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/planner/knowledge.hpp"
#include "core/planner/next_best_view.hpp"
#include "core/planner/policy.hpp"

namespace nextview {

/// What planning goes by, besides what is known.
struct PlanningSetup {
  const PlannerConfig& config;
  std::uint64_t seed;
  double occlusion_reach;  ///< d_max of proximity count [voxels]
  double scan_seconds;     ///< what taking a scan counts for in a utility per second
  const RayBundle& bundle;
  const TrueSurface* true_surface;         ///< null where it is not known, not evaluated, or not asked for by needs()
  double negligible_share = 0.005;         ///< of the surface: for less no view is worth it (termination.surface_left)
  const RayBundle* fine_bundle = nullptr;  ///< that scores the best views again; null: none does
  std::size_t most_views = 10'000;         ///< so many end the scan (termination.views)
};

/// What a planner made of the candidates: each with its gain and utility, and which is best.
struct Plan {
  std::vector<Candidate> candidates;
  Ranking ranking;
  std::optional<double> surface_left = {};  ///< Valuation::surface_left of the available candidates
};

/// Decides where to look next.
class Planner {
 public:
  virtual ~Planner() = default;
  /// Of its gains, for people: "nats", "voxels", …, or "" if they have none.
  virtual std::string unit() const { return ""; }
  virtual PolicyNeeds needs() const { return {}; }
  /// Values the available candidates among `views` and finds the next best one. `candidates`, one per view, say which
  /// are available and what going there costs. @throws Stopped
  virtual Plan plan(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                    std::vector<Candidate> candidates, std::stop_token stop) const = 0;
  /// Why no rays explain its gains, to be read behind its name; empty if they do.
  virtual std::string no_explanation() const { return "ranks views without rays"; }
  /// Why a view would have its gain; nothing if no rays explain it.
  /// `surface_left` is its plan's for what is known; none if there is no plan.
  virtual std::optional<ScoreExplanation> explain(const PlanningSetup&, const Knowledge&, const Pose&,
                                                  std::optional<double> /*surface_left*/) const {
    return std::nullopt;
  }
};

/// Ranks views one by one by a policy's values and the way there (Eqs. 13, 14).
class OneStepPlanner : public Planner {
 public:
  explicit OneStepPlanner(std::unique_ptr<const Policy> policy) : policy_(std::move(policy)) {}
  std::string unit() const override { return policy_->unit(); }
  PolicyNeeds needs() const override { return policy_->needs(); }
  std::string no_explanation() const override { return policy_->no_explanation(); }
  Plan plan(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
            std::vector<Candidate> candidates, std::stop_token stop) const override;
  std::optional<ScoreExplanation> explain(const PlanningSetup& setup, const Knowledge& known,
                                          const Pose& T_world_camera,
                                          std::optional<double> surface_left) const override;

 protected:
  /// Which of the ranked candidates is taken, and what is to be said of that.
  struct Choice {
    std::size_t candidate;
    std::string because = {};
  };
  /// @pre some candidate is available, and `ranked` is the best of them @throws Stopped
  virtual Choice choose(const PlanningState&, std::span<const Candidate>, const Utility&, std::size_t ranked,
                        const std::stop_token&) const {
    return {ranked};
  }

 private:
  std::unique_ptr<const Policy> policy_;
};

/// Says which views can be chosen from. What they are may depend on what is known.
class CandidateGenerator {
 public:
  virtual ~CandidateGenerator() = default;
  virtual std::vector<View> candidates(const Knowledge& known) const = 0;
};

/// The same views all the time.
class FixedCandidates : public CandidateGenerator {
 public:
  explicit FixedCandidates(std::vector<View> views) : views_(std::move(views)) {}
  std::vector<View> candidates(const Knowledge&) const override { return views_; }

 private:
  std::vector<View> views_;
};

}  // namespace nextview
