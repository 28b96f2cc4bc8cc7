#pragma once
#include <functional>

#include "core/study/study_folder.hpp"
#include "core/study/study_summary.hpp"

namespace nextview {

/// Which runs of a study one program does.
struct StudyShare {
  RunRange range;                     ///< these, counted from 1
  std::size_t shard = 1, shards = 1;  ///< of which each n-th, beginning with the shard-th; from 1

  bool takes(std::size_t number) const {
    return number >= range.first && number <= range.last && (number - 1) % shards == shard - 1;
  }
};

/// Hears of each run that was done.
using RunDone = std::function<void(std::size_t number, const StudyRun&, const RunResult&, const RunSeconds&)>;

/// Does the runs of this share that the folder does not hold yet, one after the other; each on all threads. A run that
/// is wrong is a result too. Whatever ends the program, the runs that were done stay.
/// @throws Stopped; OutOfMemory; std::runtime_error if the folder cannot be written
void run_study(const Study& study, const StudyKeys& keys, const StudyFolder& folder, const StudyShare& share,
               bool keep_scans, const RunDone& done, const Progress& progress, const std::stop_token& stop);

}  // namespace nextview
