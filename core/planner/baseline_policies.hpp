#pragma once
#include "core/planner/policy.hpp"

namespace nextview {

/// What a planner is compared with. It ranks by other means than volumetric information.
class BaselinePolicy : public Policy {
 public:
  bool ignores_cost() const override { return true; }
};

/// A baseline that values each candidate for itself.
class SingleViewPolicy : public BaselinePolicy {
 public:
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;

 protected:
  /// The larger, the sooner.
  virtual double value(const PlanningState& state, std::size_t candidate) const = 0;
};

/// Draws a number for each candidate; others at each step.
class RandomPolicy : public SingleViewPolicy {
  double value(const PlanningState& state, std::size_t candidate) const override;
};

/// Measures the distance to the nearest view taken.
class FarthestPolicy : public SingleViewPolicy {
 public:
  std::string unit() const override { return "m"; }

 private:
  double value(const PlanningState& state, std::size_t candidate) const override;
};

/// Counts down.
class FixedOrderPolicy : public SingleViewPolicy {
  double value(const PlanningState& state, std::size_t candidate) const override;
};

/// The random order of a model-based covering set (the paper's VI-E).
class CoveringOrderPolicy : public BaselinePolicy {
 public:
  PolicyNeeds needs() const override { return {false, false, true}; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;
};

/// A least set of candidates that see nearly all that any of them sees, made anew after each view; of the set, and then
/// of the others, the one that sees most first.
class SetCoverPolicy : public BaselinePolicy {
 public:
  static constexpr double enough = 0.99;  ///< share of the surface that any candidate sees
  PolicyNeeds needs() const override { return {false, false, true}; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;
};

/// Counts the surface samples that would be seen for the first time.
class OraclePolicy : public SingleViewPolicy {
 public:
  std::string unit() const override { return "samples"; }
  PolicyNeeds needs() const override { return {false, false, true}; }

 private:
  double value(const PlanningState& state, std::size_t candidate) const override;
};

}  // namespace nextview
