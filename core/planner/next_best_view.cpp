#include "core/planner/next_best_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

/// Gains that differ by less than this share of the largest count as tied.
constexpr double tolerance = 1e-9;

std::string degeneracy_reason(const std::vector<double>& gains) {
  if (!std::all_of(gains.begin(), gains.end(), [](double g) { return std::isfinite(g); }))
    return "the gain of a candidate is not a finite number";
  if (gains.size() < 2) return "";
  const double smallest = *std::min_element(gains.begin(), gains.end());
  const double largest = *std::max_element(gains.begin(), gains.end());
  if (largest == 0.0 && smallest == 0.0) return "the gain is 0 for every candidate: it expects nothing new of any";
  if (largest - smallest <= tolerance * std::abs(largest))
    return fmt::format("the gain is {:.6g} for every candidate: it does not tell them apart", largest);
  const auto ties =
      std::count_if(gains.begin(), gains.end(), [&](double g) { return largest - g <= tolerance * std::abs(largest); });
  if (ties * 2 > static_cast<std::ptrdiff_t>(gains.size()))
    return fmt::format("{} of {} candidates tie at the largest gain, {:.6g}", ties, gains.size(), largest);
  return "";
}

}  // namespace

bool is_better(const Candidate& a, const Candidate& b) {
  return a.overlaps != b.overlaps ? a.overlaps : a.utility > b.utility;
}

std::optional<std::size_t> runner_up(std::span<const Candidate> candidates, std::size_t best) {
  std::optional<std::size_t> second;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (v != best && candidates[v].available && (!second || is_better(candidates[v], candidates[*second]))) second = v;
  return second;
}

Ranking rank(std::span<Candidate> candidates, const Utility& utility) {
  const UtilityWeights& weights = utility.weights;
  double gain_sum = 0.0, cost_sum = 0.0;
  std::vector<double> gains;
  for (const Candidate& c : candidates) {
    if (!c.available) continue;
    gain_sum += c.gain;
    cost_sum += c.cost;
    gains.push_back(c.gain);
  }
  Ranking ranking;
  for (std::size_t v = 0; v < candidates.size(); ++v) {
    Candidate& c = candidates[v];
    c.utility = 0.0;
    if (!c.available) continue;
    if (utility.scan_seconds) {
      c.utility = c.gain / (c.seconds + *utility.scan_seconds);
    } else {
      if (gain_sum != 0.0) c.utility += weights.gain * c.gain / gain_sum;  // Eq. 13
      if (cost_sum != 0.0) c.utility -= weights.cost * c.cost / cost_sum;
    }
    if (!ranking.best || is_better(c, candidates[*ranking.best])) ranking.best = v;  // Eq. 14
  }
  ranking.degenerate = degeneracy_reason(gains);
  return ranking;
}

}  // namespace nextview
