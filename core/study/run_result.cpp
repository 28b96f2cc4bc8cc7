#include "core/study/run_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/file/json_text.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::uintmax_t largest_result = 1 << 24;  // [bytes]

}  // namespace

void RunResult::add(const std::string& measure, double at, double value) {
  if (std::isfinite(value)) measured[measure].push_back({at, value});
}

const MeasuredValue* RunResult::find(const std::string& measure, double at) const {
  const auto values = measured.find(measure);
  if (values == measured.end()) return nullptr;
  const auto found = std::ranges::find(values->second, at, &MeasuredValue::at);
  return found == values->second.end() ? nullptr : &*found;
}

RunResult perform(const Study& study, const StudyRun& run, SharedByRuns& shared, RunSeconds& seconds,
                  const std::optional<std::filesystem::path>& session_folder, const Progress& progress,
                  const std::stop_token& stop) {
  const Stopwatch watch(seconds.total);
  try {
    const Configuration c = configuration_of(study, run);
    c.validate();
    if (run.part == StudyPart::maps) return perform_map(c, study.map_kind(run), shared, seconds, progress, stop);
    return perform_plan(c, shared, seconds, session_folder, progress, stop);
  } catch (const Stopped&) {
    throw;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    RunResult broken;
    broken.failure = printable(error.what());
    return broken;
  }
}

std::string to_json(const RunResult& result, const std::string& key, const StudyRun& run) {
  Json json = {{"key", key},           {"part", name(run.part)}, {"object", run.object},
               {"sensor", run.sensor}, {"views", run.views},     {"method", run.method},
               {"start", run.start},   {"seed", run.seed},       {"failure", result.failure}};
  Json& measured = json["measured"] = Json::object();
  for (const auto& [measure, values] : result.measured)
    for (const MeasuredValue& m : values) measured[measure].push_back({m.at, m.value});
  return json_text(json) + "\n";
}

RunResult read_result(const std::filesystem::path& file) {
  const std::string text = read_file(file, largest_result);
  try {
    const Json json = parse_json<Json>(text);
    RunResult result;
    result.failure = json.at("failure").get<std::string>();
    for (const auto& [measure, values] : json.at("measured").items())
      for (const Json& pair : values) result.add(measure, pair.at(0).get<double>(), pair.at(1).get<double>());
    return result;
  } catch (const Json::exception&) {
    throw std::runtime_error(fmt::format("{}: is no result of a study's run", file.string()));
  }
}

}  // namespace nextview
