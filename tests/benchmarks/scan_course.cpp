#include "tests/benchmarks/scan_course.hpp"

#include <algorithm>
#include <numeric>

namespace nextview {

void ScanCourse::add(const ScanCourse& other, double weight) {
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    coverage[i] += weight * other.coverage[i];
    path[i] += weight * other.path[i];
  }
}

double ScanCourse::mean_coverage() const {
  return std::accumulate(coverage.begin(), coverage.end(), 0.0) / double(coverage.size());
}

double ScanCourse::way_to(double share) const {
  const auto after = std::size_t(std::ranges::lower_bound(coverage, share) - coverage.begin());
  const double part = (share - coverage[after - 1]) / (coverage[after] - coverage[after - 1]);
  return path[after - 1] + part * (path[after] - path[after - 1]);
}

ScanCourse course_of_scan(Session& session, const std::vector<std::size_t>& views) {
  while (session.finished().empty()) {
    const std::size_t taken = session.records().size();
    if (taken > 0 && taken <= views.size()) session.override_next_view(views[taken - 1]);
    session.step();
  }
  ScanCourse course(session.configuration().termination.views);
  double path = 0.0;
  for (std::size_t i = 0; i < course.coverage.size(); ++i) {
    const StepRecord& record = session.records().at(std::min(i, session.records().size() - 1));
    path += i < session.records().size() ? record.motion.distance : 0.0;
    course.coverage[i] = record.coverage_visible;
    course.path[i] = path;
  }
  return course;
}

ScanCourse course_of_scan(const Configuration& configuration) {
  Session session(configuration);
  return course_of_scan(session);
}

EqualCoverage EqualCoverage::of(const ScanCourse& course, const ScanCourse& oracle) {
  constexpr int levels = 200;
  const double first = std::max(course.coverage.front(), oracle.coverage.front());
  const double last = std::min(course.coverage.back(), oracle.coverage.back());
  EqualCoverage equal;
  if (last <= first) return equal;  // the first view showed all there is
  for (int i = 1; i <= levels; ++i) {
    const double share = first + (last - first) * (i - 0.5) / levels;
    equal.way += course.way_to(share) / levels, equal.oracles += oracle.way_to(share) / levels;
  }
  return equal;
}

}  // namespace nextview
