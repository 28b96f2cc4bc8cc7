#pragma once
#include <span>

namespace nextview {

/// Fits to made-up parts what posterior_comparison compares, and prints it as C++ has it: the read-outs ...
void fit_read_outs(std::span<const int> numbers_of_views);
/// ... and the conventional map's terms, for each sensor that is compared. To the Gibbs map they are fitted as the
/// read-out has it that this was built with: after new ones, fit them again.
void fit_terms(std::span<const int> numbers_of_views);

}  // namespace nextview
