#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/evaluation/entropy.hpp"
#include "core/evaluation/recorded_surface.hpp"
#include "core/session/step_record.hpp"
#include "ui/charts/chart.hpp"

namespace nextview {

/// How a scan went, view by view: what its curves are made of. Spans and pointers need to live while it is used only.
struct ScanCourse {
  std::span<const StepRecord> records;
  MapEntropy start;      ///< of the map before the first view
  double d_reg = 0.005;  ///< [m]
  std::string gain_unit;
  bool is_evaluated = true;                 ///< compared with a true surface
  const CoverageByOrder* orders = nullptr;  ///< of a recording, once a view was taken
};

ChartContent entropy_chart(const ScanCourse& course);
ChartContent coverage_chart(const ScanCourse& course);
/// Of what all frames of a recording show: by this order of them, and by others.
ChartContent recorded_coverage_chart(const ScanCourse& course);
ChartContent divergence_chart(const ScanCourse& course);
ChartContent gain_chart(const ScanCourse& course);
/// Of each stage of a step; another run has other seconds.
ChartContent time_chart(const ScanCourse& course);

/// Those that are the same in every run, as far as what they show is known.
std::vector<ChartContent> scan_charts(const ScanCourse& course);

}  // namespace nextview
