#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/study/study_summary.hpp"

namespace nextview {

/// Mean and standard deviation of numbers that come one after the other (Welford 1962).
class MeanSpread {
 public:
  void add(double value);
  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  double spread() const;  ///< 0 of fewer than two

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// A run's place in its study, and what it came to.
struct FinishedRun {
  std::size_t number = 0;  ///< from 1
  std::string key;
  StudyRun run;
  RunResult result;
};

/// The rows of a block of runs, and at its end the means over its objects.
class SummaryRows {
 public:
  using Take = std::function<void(const SummaryRow&)>;
  using Place = std::pair<std::string, double>;  ///< measure, at
  SummaryRows(const StudyBlock& block, Take take) : block_(block), take_(std::move(take)) {}

  /// All runs of one object, sensor and number of views, in their order.
  void add(const std::vector<FinishedRun>& runs);
  void finish();

 private:
  using Means = std::map<Place, MeanSpread>;
  struct Group {
    SummaryRow head;
    std::vector<const FinishedRun*> runs;
    Means means;
  };
  /// What the means over objects are gathered by, in the order of the study.
  struct OverObjects {
    SummaryRow head;
    Means means;
    std::map<Place, std::size_t> better;
  };

  std::vector<Group> groups_of(const std::vector<FinishedRun>& runs) const;
  void take(const Group& group, const Place& place, const MeanSpread& values, std::optional<std::size_t> better = {});
  void compare(const Group& group, const Group& reference);
  /// "gap_closed" of what these say, of one object or of the means of all.
  template <class Several>
  static std::vector<std::optional<double>> gaps_closed(const Several& groups);
  void finish_gaps();
  OverObjects& over_objects(const SummaryRow& row);

  const StudyBlock& block_;
  Take take_;
  std::vector<OverObjects> over_objects_;
};

}  // namespace nextview
