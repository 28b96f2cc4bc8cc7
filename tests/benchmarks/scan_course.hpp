#pragma once
#include <vector>

#include "core/session/session.hpp"

namespace nextview {

/// Coverage of the visible surface, and metres, after each view of a scan.
struct ScanCourse {
  std::vector<double> coverage, path;

  explicit ScanCourse(int views) : coverage(static_cast<std::size_t>(views)), path(coverage.size()) {}
  void add(const ScanCourse& other, double weight);
  double mean_coverage() const;
  /// Metres to a coverage, as if it grew evenly from view to view. @pre it is reached, and not by the first view
  double way_to(double share) const;
};

/// Scans to the end, after the first view by these candidates as far as they reach; of a scan that ends before
/// termination.views its last view counts for those that are missing.
ScanCourse course_of_scan(Session& session, const std::vector<std::size_t>& views = {});
ScanCourse course_of_scan(const Configuration& configuration);

/// The way of a plan beside the oracle's, to the same coverage: mean over all that both reach after their first view
/// [m].
struct EqualCoverage {
  double way = 0.0, oracles = 0.0;

  static EqualCoverage of(const ScanCourse& course, const ScanCourse& oracle);
  double share() const { return way / oracles; }
};

}  // namespace nextview
