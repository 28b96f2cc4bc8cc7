#pragma once
#include <span>

namespace nextview {

/// Fits to made-up parts what posterior_comparison compares, and prints it as C++ has it: the read-outs, and the
/// conventional map's terms. Those that are fitted to the Gibbs map are fitted to it as the read-out has it that this
/// was built with: after new ones, a second time.
void fit_posterior(std::span<const int> numbers_of_views);

}  // namespace nextview
