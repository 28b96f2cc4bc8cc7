#pragma once
#include <map>
#include <string>

#include "core/session/step_record.hpp"

namespace nextview {

/// What the curves show of a step, by name; not what it took, which differs from run to run (timings.hpp).
std::map<std::string, double> outcome_of(const StepRecord& record);
/// A record with this outcome, and without candidates. Names that are not known are left out.
StepRecord record_with(const std::map<std::string, double>& outcome);

}  // namespace nextview
