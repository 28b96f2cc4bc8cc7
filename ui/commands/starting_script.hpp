#pragma once
#include <string>
#include <vector>

#include "core/config/configuration.hpp"

namespace nextview {

/// The lines of a script that lead from the default configuration to this one: `open`, then a `set` a setting that
/// differs.
std::vector<std::string> starting_script(const Configuration& configuration);

}  // namespace nextview
