#pragma once
#include <span>
#include <string>

#include "core/planner/policy.hpp"
#include "core/planner/termination.hpp"
#include "core/robot/robot.hpp"
#include "core/session/step_record.hpp"

namespace nextview {

// What follows a measurement: how the candidates rank, and whether the scan is done.

/// Ranks the candidates that are not visited and within the robot's reach by a policy on the state's map: sets
/// the record's `candidates` and `ranking`. @throws Stopped
void rank_candidates(const Policy& policy, const PlanningState& state, const Robot& robot,
                     const std::vector<bool>& visited, StepRecord& record, const std::stop_token& stop = {});

/// What the same gain would have made of the conventional map, whose rays `conventional` has: sets the record's
/// refinement. @throws Stopped @pre the record is ranked and has a refinement
void compare_rankings(const Policy& policy, const PlanningState& conventional, StepRecord& record,
                      const std::stop_token& stop = {});

/// Why the scan is done, for people; empty while it is not. `voxels`: how many the map has. @pre !records.empty()
std::string termination(const TerminationConfig& config, std::span<const StepRecord> records, std::size_t voxels);

}  // namespace nextview
