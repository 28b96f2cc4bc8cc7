#pragma once
#include "core/config/configuration.hpp"

namespace nextview {

/// What ranks which views. It may change while a scan goes on: what was scanned stays.
struct PlanningConfig {
  PlannerConfig planner;
  CandidateViewsConfig views;
  GibbsConfig gibbs;  ///< by which the map is refined for a planner that needs it, from the same scans
};

inline PlanningConfig planning_of(const Configuration& configuration) {
  return {configuration.planner, configuration.views, configuration.gibbs};
}

inline Configuration with_planning(Configuration configuration, const PlanningConfig& planning) {
  configuration.planner = planning.planner;
  configuration.views = planning.views;
  configuration.gibbs = planning.gibbs;
  return configuration;
}

}  // namespace nextview
