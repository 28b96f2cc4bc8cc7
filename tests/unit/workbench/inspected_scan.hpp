#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/workbench/job_control.hpp"
#include "tests/unit/workbench/small_scan.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {

inline Configuration scan_by(const std::string& gain, Semantics semantics = Semantics::published) {
  Configuration c = small_scan();
  c.planner.gain = gain;
  c.planner.semantics = semantics;
  return c;
}

/// A session that can be inspected after each step.
struct InspectedScan {
  explicit InspectedScan(const Configuration& configuration) { runner.load(configuration, job_control()); }
  void step() { runner.step(job_control()); }
  const SessionSnapshot& now() { return *runner.snapshot(); }
  Inspection look(const Selection& selection) { return inspector.inspect(runner.snapshot(), selection); }
  ViewInspection look_at(ViewSelection view) {
    Selection selection;
    selection.view = view;
    return look(selection).view.value();
  }

  SessionRunner runner;
  Inspector inspector;
};

/// A voxel, and no view, which would take longer.
inline Selection only_voxel(std::uint32_t voxel) {
  Selection selection;
  selection.view = {ViewSelection::Kind::custom, 0};
  selection.voxel = voxel;
  return selection;
}

inline bool equal(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)}); }

/// That an explanation adds up: voxels to rays, rays to the value.
inline void expect_sum(const ScoreExplanation& e, const std::string& what) {
  double sum = 0;
  for (const auto& ray : e.rays) {
    double ray_sum = 0;
    for (const auto& voxel : ray.voxels) ray_sum += voxel.contribution;
    EXPECT_TRUE(equal(ray_sum, ray.contribution)) << what << ": " << ray_sum << " is not " << ray.contribution;
    sum += ray.contribution;
  }
  EXPECT_TRUE(equal(sum, e.value)) << what << ": " << sum << " is not " << e.value;
}

}  // namespace nextview
