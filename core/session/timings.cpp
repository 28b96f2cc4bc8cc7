#include "core/session/timings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "core/file/read_file.hpp"

namespace nextview {

std::string timings_csv(const Session& session) {
  std::string csv = "step,sense[s],clean[s],insert[s],refine[s],score[s],evaluate[s]\n";
  for (const StepRecord& r : session.records())
    csv += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", r.step, r.seconds.sense, r.seconds.clean,
                       r.seconds.insert, r.seconds.refine, r.seconds.score, r.seconds.evaluate);
  return csv;
}

std::vector<StageSeconds> read_timings(const std::filesystem::path& folder) {
  std::vector<StageSeconds> timings;
  try {
    constexpr std::uintmax_t largest = 1 << 24;  // [bytes]
    std::istringstream csv(read_file(folder / timings_name, largest));
    std::string line;
    std::getline(csv, line);
    while (std::getline(csv, line)) {
      StageSeconds s;
      int step = 0;
      if (std::sscanf(line.c_str(), "%d,%lf,%lf,%lf,%lf,%lf,%lf", &step, &s.sense, &s.clean, &s.insert, &s.refine,
                      &s.score, &s.evaluate) != 7 ||
          !std::isfinite(s.sense + s.clean + s.insert + s.refine + s.score + s.evaluate))
        break;
      timings.push_back(s);
    }
  } catch (const std::runtime_error&) {  // there is none
  }
  return timings;
}

}  // namespace nextview
