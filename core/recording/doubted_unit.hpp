#pragma once
#include <string>

#include "core/recording/dataset_guess.hpp"

namespace nextview {

/// What is likely the unit of recorded data that seems wrong, and what sets it, a sentence for people; empty if all
/// seems right. `apart`: as the farthest cameras stand; `range`: that they see on average [m].
std::string doubted_unit(const DescribedDataset& dataset, double apart, double range);

}  // namespace nextview
