#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nextview {

/// One candidate view as the planner ranks it.
struct Candidate {
  bool available = true;         ///< not yet taken, and reachable
  double gain = 0.0;             ///< in the gain's own unit
  double cost = 0.0;             ///< of going there (distance [m])
  double utility = 0.0;          ///< set by rank()
  double seconds = 0.0;          ///< of going there, as the robot says
  std::string unreachable = {};  ///< why the robot cannot go there; empty if it can
  bool overlaps = true;          ///< with what was scanned, enough to be registered; others are chosen where none does
};

struct UtilityWeights {
  double gain = 1.0;
  double cost = 1.0;
};

/// What weighs a gain against the way to it.
struct Utility {
  UtilityWeights weights;
  /// Of taking a scan. If given, utility is the gain per second of going there and scanning, whatever the weights are.
  std::optional<double> scan_seconds = {};
};

/// A ranking and whether it says anything.
struct Ranking {
  std::optional<std::size_t>
      best;                    ///< Eq. 14; nothing if no candidate is available. Ties go to the first in list order
  std::string degenerate;      ///< why the gains do not tell the candidates apart; empty if they do
  std::string reason;          ///< of the choice, in one sentence for people; empty without a best
  std::string gain_unit = {};  ///< of the candidates' gains: the planner's
};

/// Whether one is to be taken rather than another (Eq. 14): those that overlap before those that do not.
bool is_better(const Candidate& a, const Candidate& b);

/// The available candidate of largest utility but `best`; nothing if there is none.
std::optional<std::size_t> runner_up(std::span<const Candidate> candidates, std::size_t best);

/// Sets the utility of the available candidates, U = w_g G / sum G - w_c C / sum C (Eq. 13; a term whose sum is 0 is
/// 0) or the gain per second, and finds the next best view.
Ranking rank(std::span<Candidate> candidates, const Utility& utility);

}  // namespace nextview
