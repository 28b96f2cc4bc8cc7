#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nextview {

/// How much of an element a view covers: an area, or 1 of what is seen or not.
struct Covered {
  std::uint32_t element = 0;
  float amount = 0.0f;  ///< not below 0
};

/// How far the least cover is looked for. No clock has a say: the same cover every time.
struct CoverLimits {
  std::size_t views = 64;  ///< with more to choose from no proof is tried
  std::size_t fewest = 5;  ///< if the greedy cover takes more views, no proof is tried
  int cuts = 60;           ///< before branch and bound
  int nodes = 10;          ///< of branch and bound, in all
  int rounds = 1;          ///< of branch and bound: each learns from the one before it

  /// For a number to compare with, not for an operator who waits: seconds.
  static CoverLimits patient() { return {256, 100, 200, 300, 6}; }
};

/// Views that together cover enough.
struct SetCover {
  std::vector<std::size_t> views;  ///< by number; each adds most of all that are left
  bool is_least = false;           ///< proven: no fewer would do
};

/// Few views that leave no more than `left` of what all of them cover, where of each element counts what the view
/// covers that covers most of it. `views`: the elements of each, each once. The fewest by branch and bound (CBC) where
/// the limits allow; otherwise the view that adds most, again and again.
SetCover least_cover(std::span<const std::vector<Covered>> views, double left, const CoverLimits& limits = {});

}  // namespace nextview
