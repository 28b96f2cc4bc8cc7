#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/study/study_summary.hpp"

namespace nextview {

/// What methods were compared under: in one block of a study, a sensor and a number of views.
struct StudySetting {
  StudyPart part = StudyPart::planning;
  std::size_t block = 1;  ///< from 1
  std::string sensor;
  int views = 0;
  bool operator==(const StudySetting&) const = default;
};

/// A study's summary to ask.
class SummaryTable {
 public:
  /// summary.csv of a study's folder. @throws std::runtime_error naming the file, and the line that is no row
  explicit SummaryTable(const std::filesystem::path& folder);

  struct Point {
    double at = 0.0, mean = 0.0, spread = 0.0;
  };
  /// A measure over what it is at, ascending. Empty if there is none.
  std::vector<Point> course(const StudySetting& setting, const std::string& object, const std::string& method,
                            const std::string& measure) const;
  std::optional<double> value(const StudySetting& setting, const std::string& object, const std::string& method,
                              const std::string& measure) const;
  /// Those that have a measure, in the order of the file, that with the most methods first.
  std::vector<StudySetting> settings(StudyPart part, const std::string& measure) const;
  std::vector<std::string> methods(const StudySetting& setting, const std::string& measure) const;
  /// Without the mean.
  std::vector<std::string> objects(const StudySetting& setting, const std::string& measure) const;
  std::span<const SummaryRow> rows() const { return rows_; }

 private:
  std::vector<std::string> distinct(const StudySetting& setting, const std::string& measure,
                                    const std::function<const std::string&(const SummaryRow&)>& of) const;
  std::vector<SummaryRow> rows_;
};

/// A row of timings.csv.
struct TimingRow {
  std::string part, object, sensor;
  int views = 0;
  std::string method;
  RunSeconds seconds;
};
/// Of a study's folder; empty without. A row that is not whole is left out.
std::vector<TimingRow> read_study_timings(const std::filesystem::path& folder);

}  // namespace nextview
