#pragma once
#include "core/planner/policy.hpp"

namespace nextview {

/// A view is worth its volumetric information.
class GainPolicy : public Policy {
 public:
  explicit GainPolicy(const Gain& gain) : gain_(gain) {}
  std::string unit() const override { return std::string(gain_.unit); }
  PolicyNeeds needs() const override { return {gain_.needs_occlusion, gain_.needs_posterior, false}; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;
  const Gain* gain() const override { return &gain_; }
  std::string no_explanation() const override { return ""; }
  std::optional<ScoreExplanation> explain(const PlanningState& state, const Pose& T_world_camera) const override;

 private:
  const Gain& gain_;
};

/// Isler et al. 2016: a weighted sum of gains, each as a share of its sum over the candidates.
class CombinedPolicy : public Policy {
 public:
  /// @param weights `gain=weight,gain=weight`; empty: the pre-release weights. @throws std::invalid_argument
  explicit CombinedPolicy(const std::string& weights);
  PolicyNeeds needs() const override;
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;
  std::string no_explanation() const override {
    return "weighs several gains over all candidates; it has no rays of its own";
  }

 private:
  std::vector<const Gain*> gains_;
  std::vector<double> weights_;
};

}  // namespace nextview
