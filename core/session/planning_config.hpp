#pragma once
#include "core/config/configuration.hpp"

namespace nextview {

/// What ranks which views. It may change while a scan goes on: what was scanned stays.
struct PlanningConfig {
  PlannerConfig planner;
  CandidateViewsConfig views;
};

inline PlanningConfig planning_of(const Configuration& configuration) {
  return {configuration.planner, configuration.views};
}

}  // namespace nextview
