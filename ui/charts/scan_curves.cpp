#include "ui/charts/scan_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

bool any(const StepRecord&) { return true; }

struct Value {
  const char* name;
  std::function<double(const StepRecord&)> of;
  std::function<bool(const StepRecord&)> is_there = any;
  std::optional<double> at_start = {};  ///< before the first view
};

void add_series(ChartContent& content, const ScanCourse& course, const std::vector<Value>& values) {
  for (const Value& value : values) {
    ChartSeries series{value.name, {}, {}};
    if (value.at_start && (course.records.empty() || value.is_there(course.records.front()))) {
      series.x.push_back(0);
      series.y.push_back(*value.at_start);
    }
    for (const StepRecord& r : course.records) {
      if (!value.is_there(r)) continue;
      series.x.push_back(r.step);
      series.y.push_back(value.of(r));
    }
    content.series.push_back(std::move(series));
  }
}

}  // namespace

ChartContent entropy_chart(const ScanCourse& course) {
  ChartContent content{"Entropy of the map [Mbit]", "view", "", "entropy", "Mbit", {}, {}, true};
  const auto total = [](const StepRecord& r) { return r.total_entropy / 1e6; };
  const auto refined = [](const StepRecord& r) { return r.refinement.has_value(); };
  const auto conventional = [&](const StepRecord& r) { return !refined(r); };
  const double at_start = course.start.total / 1e6;
  std::vector<Value> values = {
      {"unmeasured entropy", [](const StepRecord& r) { return r.entropy / 1e6; }, any, course.start.unmeasured / 1e6}};
  // Of two maps, where the gain was changed to or from one that needs the Gibbs map, it is two curves.
  if (std::ranges::any_of(course.records, refined) && std::ranges::any_of(course.records, conventional)) {
    values.push_back({"total entropy", total, conventional, at_start});
    values.push_back({"total entropy, Gibbs map", total, refined, at_start});
  } else {
    values.push_back({"total entropy", total, any, at_start});
  }
  add_series(content, course, values);
  return content;
}

ChartContent recorded_coverage_chart(const ScanCourse& course) {
  const std::string title = fmt::format("Of all frames, within {} [%]", length_text(course.d_reg));
  ChartContent content{title, "view", "", "coverage", "%", {}, 100.0, true};
  if (!course.orders) return content;
  const auto add = [&](const char* name, const std::vector<double>& shares) {
    ChartSeries series{name, {}, {}};
    for (std::size_t k = 0; k < shares.size(); ++k) {
      series.x.push_back(double(k + 1));
      series.y.push_back(100.0 * shares[k]);
    }
    content.series.push_back(std::move(series));
  };
  add("planned", course.orders->planned);
  add("as recorded", course.orders->recorded);
  add("random", course.orders->random);
  return content;
}

ChartContent coverage_chart(const ScanCourse& course) {
  const std::string title = fmt::format("Surface within {:.3g} mm of a point [%]", 1e3 * course.d_reg);
  ChartContent content{title, "view", "", "coverage", "%", {}, 100.0, true};
  add_series(content, course,
             {{"of visible surface", [](const StepRecord& r) { return 100 * r.coverage_visible; }, any, 0.0},
              {"of all surface", [](const StepRecord& r) { return 100 * r.coverage; }, any, 0.0}});
  return content;
}

ChartContent divergence_chart(const ScanCourse& course) {
  ChartContent content{"D_KL to the truth, visited voxels [knats]", "view", "", "D_KL", "knats", {}, {}, true};
  add_series(content, course, {{"conventional map", [](const StepRecord& r) { return r.quality.divergence / 1e3; }}});
  return content;
}

/// What a planner expects of a view, beside what it brought in the same unit: nats (Eq. 12), or new surface, which is
/// also what counts where a planner has another unit, or none.
ChartContent gain_chart(const ScanCourse& course) {
  // The start view, which nobody chose, has none, nor have those of a planner with another unit.
  const auto is_there = [&](const StepRecord& r) { return r.view >= 0 && r.gain_unit == course.gain_unit; };
  if (course.gain_unit == "nats") {
    ChartContent nats{"Gain predicted and realised [nats]", "view", "", "gain", "nats", {}, {}, true};
    add_series(nats, course,
               {{"realised (Eq. 12)", [](const StepRecord& r) { return r.realised_gain; }},
                {"predicted", [](const StepRecord& r) { return r.gain; }, is_there}});
    return nats;
  }
  ChartContent surface{"New surface of a view [cm²]", "view", "", "new surface", "cm²", {}, {}, true};
  add_series(surface, course, {{"seen", [](const StepRecord& r) { return r.new_surface; }}});
  if (course.gain_unit == "cm²")
    add_series(surface, course, {{"expected", [](const StepRecord& r) { return r.gain; }, is_there}});
  return surface;
}

ChartContent time_chart(const ScanCourse& course) {
  ChartContent content{"Time of a step [s]", "view", "", "time", "s", {}, {}, true};
  add_series(content, course,
             {{"score", [](const StepRecord& r) { return r.seconds.score; }},
              {"insert", [](const StepRecord& r) { return r.seconds.insert; }},
              {"sense, clean", [](const StepRecord& r) { return r.seconds.sense + r.seconds.clean; }},
              {"evaluate", [](const StepRecord& r) { return r.seconds.evaluate; }},
              {"refine", [](const StepRecord& r) { return r.seconds.refine; }}});
  return content;
}

std::vector<ChartContent> scan_charts(const ScanCourse& course) {
  std::vector<ChartContent> charts = {entropy_chart(course)};
  if (course.orders)
    charts.push_back(recorded_coverage_chart(course));
  else if (course.is_evaluated)
    charts.push_back(coverage_chart(course));
  charts.push_back(gain_chart(course));
  if (course.is_evaluated) charts.push_back(divergence_chart(course));
  return charts;
}

}  // namespace nextview
