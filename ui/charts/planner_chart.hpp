#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui/render_target/image.hpp"

namespace nextview {

/// How far a policy's views cover an object.
struct PlannerCourse {
  std::string object;
  std::string policy;
  std::vector<double> coverage;  ///< of the visible surface, after view 1, 2, … [%]
};

/// The rows that `planner_comparison` prints as CSV, but for their means.
/// @throws std::runtime_error naming the file, and the line that is none of them.
std::vector<PlannerCourse> read_planner_courses(const std::filesystem::path& file);

/// Coverage against views: the mean over the objects by each policy, the best first, and beneath it each object by a
/// few of them. Drawn headless (ensure_headless). Made for 1600 x 1100 pixels and twelve objects.
/// @throws std::invalid_argument if there is no course.
Image draw_planner_chart(const std::vector<PlannerCourse>& courses, int width = 1600, int height = 1100);

}  // namespace nextview
