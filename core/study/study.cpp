#include "core/study/study.hpp"

#include <fmt/format.h>

#include <numeric>
#include <sstream>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

void apply(const std::vector<GivenSetting>& settings, Configuration& c) {
  for (const GivenSetting& s : settings)
    if (s.key != "sensor.preset") give(c, s.key, s.text, s.key, s.place);
}

/// A preset sets all of the sensor, so it comes before whatever else is said of that.
void apply_presets(const std::vector<GivenSetting>& settings, Configuration& c) {
  for (const GivenSetting& s : settings)
    if (s.key == "sensor.preset") give(c, s.key, s.text, s.key, s.place);
}

void apply_start(const std::string& start, const std::string& place, Configuration& c) {
  std::string azimuth, elevation;
  std::istringstream(start) >> azimuth >> elevation;
  give(c, "planner.start_azimuth", azimuth, "starts (planner.start_azimuth)", place);
  give(c, "planner.start_elevation", elevation, "starts (planner.start_elevation)", place);
}

fs::path named_configuration(const std::string& name) {
  const fs::path named = assets_folder() / "configurations" / (name + ".toml");
  return is_there(named) ? named : fs::path(name);
}

}  // namespace

std::string StudyRun::text() const {
  return fmt::format("{}, {}, {} views, {}{}{}, seed {}", object_label(object), sensor, views, method,
                     start.empty() ? "" : ", start ", start, seed);
}

std::size_t Study::size() const {
  return std::accumulate(blocks.begin(), blocks.end(), std::size_t{0},
                         [](std::size_t sum, const StudyBlock& block) { return sum + block.size(); });
}

StudyRun Study::run(std::size_t index) const {
  std::size_t b = 0;
  for (; index >= blocks.at(b).size(); ++b) index -= blocks[b].size();
  const StudyBlock& block = blocks[b];
  const auto take = [&](const auto& values) -> const auto& {
    const auto& value = values[index % values.size()];
    index /= values.size();
    return value;
  };
  StudyRun run;
  run.block = b;
  run.part = block.part;
  run.seed = take(block.seeds);
  run.start = take(block.starts);
  run.method = take(block.methods);
  run.views = take(block.views);
  run.sensor = take(block.sensors);
  run.object = take(block.objects);
  return run;
}

const StudyVariant& Study::variant(const StudyRun& run) const {
  static const StudyVariant plain;
  const auto& variants = run.part == StudyPart::planning ? policies : maps;
  const auto found = variants.find(run.method);
  return found == variants.end() ? plain : found->second;
}

std::string Study::map_kind(const StudyRun& run) const {
  const StudyVariant& map = variant(run);
  if (!map.kind.empty()) return map.kind;
  return run.method == "calibrated" ? "octomap" : run.method;
}

Configuration configuration_of(const Study& study, const StudyRun& run) {
  Configuration c;
  const StudyVariant& method = study.variant(run);
  const auto sensor = study.sensors.find(run.sensor);
  const bool calibrated = run.part == StudyPart::maps && run.method == "calibrated" && method.configuration.empty();
  const std::string file = calibrated ? "calibrated" : method.configuration;
  if (!file.empty()) read_settings(named_configuration(file), c);
  c.termination = {};
  c.termination.surface_left = 0.0;  // all go on as long, or they could not be compared
  const std::string& place = study.blocks[run.block].place;
  apply_presets(study.settings, c);
  if (sensor == study.sensors.end() && run.sensor != default_sensor)
    give(c, "sensor.preset", beside_study(study.file, run.sensor), "sensors (sensor.preset)", place);
  if (sensor != study.sensors.end()) apply_presets(sensor->second.settings, c);
  apply(study.settings, c);
  if (sensor != study.sensors.end()) apply(sensor->second.settings, c);
  if (run.part == StudyPart::planning && !study.policies.contains(run.method))
    give(c, "planner.gain", run.method, "policies (planner.gain)", place);
  apply(method.settings, c);
  c.object.file = beside_study(study.file, run.object);
  c.seed = run.seed;
  give(c, "termination.views", std::to_string(run.views), "views (termination.views)", place);
  if (!run.start.empty()) apply_start(run.start, place, c);
  return c;
}

std::string beside_study(const fs::path& file, const std::string& said) {
  const fs::path there = file.parent_path() / said;
  std::error_code ignored;
  return fs::path(said).is_relative() && fs::is_regular_file(there, ignored) ? there.string() : said;
}

std::string object_label(const std::string& object) { return fs::path(object).stem().string(); }

}  // namespace nextview
