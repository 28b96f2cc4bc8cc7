#pragma once
#include <string>

#include "core/gibbs/sampler_diagnostics.hpp"

namespace nextview {

/// The diagnostics without traces and times, as JSON.
std::string diagnostics_json(const SamplerDiagnostics& diagnostics);

/// "stationary after 50 sweeps (R-hat 1.003, trend 0.8, 0 voxels differ)", or the warning.
std::string diagnostics_line(const SamplerDiagnostics& diagnostics);

}  // namespace nextview
