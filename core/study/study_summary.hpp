#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/study/study_folder.hpp"

namespace nextview {

/// A line of a study's summary: one number, over some runs.
///
/// A row with an object is over the start views and seeds of one method: the mean and its spread (standard deviation;
/// 0 of a single run). With object "(mean)" it is over the objects, of whose means it is the mean and the spread.
/// "MEASURE - REFERENCE" compares pairs of runs that differ in their method alone: the mean of the differences, their
/// spread, and how many pairs are better. "gap_closed" is where a plan stands between random views (0) and the oracle
/// (1). "failure" counts runs that came to nothing; `note` has the first reason. Courses of chains and bins of
/// reliability diagrams stand with "(mean)" alone.
struct SummaryRow {
  std::string part;
  std::size_t block = 1;  ///< of the study, from 1: blocks may compare the same methods over other objects
  std::string object, sensor;
  int views = 0;
  std::string method, measure;
  double at = 0.0;
  std::size_t runs = 0;
  double mean = 0.0, spread = 0.0;
  std::optional<std::size_t> better;
  std::size_t first_run = 0, last_run = 0;  ///< that it is of, counted from 1
  std::string hash;                         ///< of the keys of these runs
  std::string note;
};

inline constexpr const char* mean_object = "(mean)";

/// Which runs: from first to last, counted from 1.
struct RunRange {
  std::size_t first = 1, last = 0;
};

struct StudySummary {
  std::size_t runs = 0, failed = 0, rows = 0;
};

/// @throws std::runtime_error naming the first of these runs that is in none of the folders
void require_results(std::span<const std::string> keys, std::span<const StudyFolder> folders, const RunRange& range);

/// Goes through the results of all these runs in their fixed order, wherever they lie, and writes summary.csv and
/// summary.json (the rows), and runs.csv (a row a run), into `out`. In memory are the runs of one object, sensor and
/// number of views, and the means of each method.
/// @throws std::runtime_error as require_results(), or if a file cannot be written
StudySummary summarise(const Study& study, std::span<const std::string> keys, std::span<const StudyFolder> folders,
                       const RunRange& range, const std::filesystem::path& out);

}  // namespace nextview
