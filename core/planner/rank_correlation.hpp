#pragma once
#include <span>

namespace nextview {

/// Spearman's rank correlation of two lists of equal length, ties taking their mean rank: 1 where they rank alike, -1
/// where the one turns the other round, 0 if either has but one value.
double rank_correlation(std::span<const double> a, std::span<const double> b);

}  // namespace nextview
