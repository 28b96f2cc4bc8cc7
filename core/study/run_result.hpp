#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/progress/progress.hpp"
#include "core/session/step_record.hpp"
#include "core/study/study.hpp"

namespace nextview {

struct SharedByRuns;

/// A number that a run measured. `at`: after so many views, in a sweep, of openings so wide [mm], …; 0 if there is one
/// alone.
struct MeasuredValue {
  double at = 0.0, value = 0.0;
  bool operator==(const MeasuredValue&) const = default;
};

/// What a run came to. The same for the same run, wherever and on however many threads.
struct RunResult {
  std::string failure;  ///< why there is nothing; empty if there is
  std::map<std::string, std::vector<MeasuredValue>>
      measured;  ///< by measure, its unit in brackets: "coverage[%]"; finite

  void add(const std::string& measure, double at, double value);  ///< what is not finite is left out
  const MeasuredValue* find(const std::string& measure, double at) const;
};

/// Seconds of a run; they differ from one to the next.
struct RunSeconds {
  StageSeconds stages;
  double total = 0.0;
};

/// The one number that stands for a run, by which methods are compared: mean coverage of a plan [%], log loss near the
/// surface of a map [nats].
constexpr const char* main_measure(StudyPart part) {
  return part == StudyPart::planning ? "mean_coverage[%]" : "log_loss_near_surface[nats]";
}
/// Whether more of it is better.
constexpr bool more_is_better(StudyPart part) { return part == StudyPart::planning; }

/// Does a run. What is wrong with its object or settings is its result. With a folder the session is kept there.
/// `shared`: by the runs before and after it, of any study; of one at a time.
/// @throws Stopped; OutOfMemory, which says nothing of the run; std::runtime_error if the folder cannot be written
RunResult perform(const Study& study, const StudyRun& run, SharedByRuns& shared, RunSeconds& seconds,
                  const std::optional<std::filesystem::path>& session_folder = {}, const Progress& progress = {},
                  const std::stop_token& stop = {});

// Of either part; throw what is wrong.
RunResult perform_plan(const Configuration& configuration, SharedByRuns& shared, RunSeconds& seconds,
                       const std::optional<std::filesystem::path>& session_folder, const Progress& progress,
                       const std::stop_token& stop);
RunResult perform_map(const Configuration& configuration, const std::string& kind, SharedByRuns& shared,
                      RunSeconds& seconds, const Progress& progress, const std::stop_token& stop);

std::string to_json(const RunResult& result, const std::string& key, const StudyRun& run);
/// @throws std::runtime_error naming the file if it is no result
RunResult read_result(const std::filesystem::path& file);

}  // namespace nextview
