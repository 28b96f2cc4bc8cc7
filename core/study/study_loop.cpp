#include "core/study/study_loop.hpp"

#include <fmt/format.h>

#include <chrono>

#include "core/progress/stopped.hpp"
#include "core/study/shared_by_runs.hpp"

namespace nextview {
namespace {

/// "3 h 20 min", "4 min", "50 s"
std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.0f} h {:.0f} min", std::floor(seconds / 3600.0), std::fmod(seconds, 3600.0) / 60.0);
}

/// How far a study has come, as a line. What is left takes as long, run by run, as what was done.
class StudyProgress {
 public:
  StudyProgress(std::size_t runs, const Progress& progress) : runs_(runs), progress_(progress) {}

  void begin(const std::string& run) {
    run_ = run;
    tell(0.0);
  }
  void tell(double fraction) const {
    if (!progress_) return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double share = (double(done_) + fraction) / double(runs_);
    const std::string left =
        done_ == 0 ? "" : fmt::format("; about {} left", duration_text(seconds / share * (1.0 - share)));
    progress_(share, fmt::format("run {} of {}: {}{}", done_ + 1, runs_, run_, left));
  }
  void end() { ++done_; }

 private:
  std::size_t runs_, done_ = 0;
  const Progress& progress_;
  std::string run_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<std::size_t> open_runs(const StudyKeys& keys, const StudyFolder& folder, const StudyShare& share) {
  std::vector<std::size_t> numbers;
  for (std::size_t number = 1; number <= keys.keys.size(); ++number)
    if (share.takes(number) && !folder.has(keys.keys[number - 1])) numbers.push_back(number);
  return numbers;
}

}  // namespace

void run_study(const Study& study, const StudyKeys& keys, const StudyFolder& folder, const StudyShare& share,
               bool keep_scans, const RunDone& done, const Progress& progress, const std::stop_token& stop) {
  const std::vector<std::size_t> numbers = open_runs(keys, folder, share);
  StudyProgress how_far(numbers.size(), progress);
  SharedByRuns shared;
  for (const std::size_t number : numbers) {
    throw_if_stopped(stop);
    const StudyRun run = study.run(number - 1);
    const std::string& key = keys.keys[number - 1];
    how_far.begin(run.text());
    RunSeconds seconds;
    const bool keeps = keep_scans && run.part == StudyPart::planning;
    const RunResult result = perform(
        study, run, shared, seconds, keeps ? std::optional(folder.session(key)) : std::nullopt,
        [&](double fraction, std::string_view) { how_far.tell(fraction); }, stop);
    folder.keep(key, run, result, seconds);
    how_far.end();
    if (done) done(number, run, result, seconds);
  }
}

}  // namespace nextview
