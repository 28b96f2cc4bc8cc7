#include <fmt/format.h>

#include "app/commands/calibrate.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/shell_text.hpp"
#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"
#include "core/export/new_surface_calibration_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/saved_session.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

void require_consistent(const CalibrateArguments& arguments) {
  if (arguments.views_given && arguments.views.size() != 1)
    throw std::invalid_argument("--views must be one number with --fit new-surface");
  if (!arguments.fitted_given) return;
  if (arguments.parts_given) throw std::invalid_argument("--parts are made up where there is no INPUT");
  for (const std::string& input : arguments.fitted)
    if (is_recorded(input))
      throw std::invalid_argument(
          fmt::format("{}: --fit new-surface learns from objects, not from finished scans", input));
}

/// What was set is fitted for alone; the rest is mixed, so that the coefficients do for many.
NewSurfaceCalibrationConfig fit_config(const CalibrateArguments& arguments, const Configuration& configuration) {
  NewSurfaceCalibrationConfig config;
  if (arguments.views_given) config.views = arguments.views.front();
  const auto given = [&](const char* key) { return configuration.sources.contains(key); };
  if (given("map.resolution")) config.resolutions = {configuration.map.resolution};
  if (given("sensor.preset") || given("sensor.width")) config.widths = {configuration.sensor.width};
  if (given("sensor.preset") || given("sensor.range_noise")) config.range_noises = {configuration.sensor.range_noise};
  return config;
}

/// Before anything is scanned.
void require_valid(Configuration configuration, const NewSurfaceCalibrationConfig& config) {
  for (const double resolution : config.resolutions) {
    configuration.map.resolution = resolution;
    configuration.validate();
  }
}

std::vector<InputFile> inputs(const CalibrateArguments& arguments, const Configuration& configuration) {
  std::vector<InputFile> files;
  for (const std::filesystem::path& file : configuration.read_from) files.push_back({file, "read as configuration"});
  if (arguments.fitted_given)
    for (const std::string& input : arguments.fitted) files.push_back({input_path(input), "what is fitted to"});
  return files;
}

std::vector<TrainingObject> objects(const CalibrateArguments& arguments, const Configuration& configuration,
                                    const Progress& progress, const std::stop_token& stop) {
  progress(0.0, "reading or making the objects");
  if (!arguments.fitted_given) return training_objects(arguments.parts, configuration.seed, stop);
  std::vector<TrainingObject> read;
  for (const std::string& input : arguments.fitted) {
    const std::filesystem::path file = resolve_object(input);
    const auto object =
        std::make_shared<const PlacedMesh>(load_object_mesh(file, placement(configuration.object, file), stop));
    require_within_region(object->mesh, configuration, file);
    read.push_back({object_name(file), object});
  }
  return read;
}

std::string remark(const CalibrateArguments& arguments, const NewSurfaceCalibration& calibration,
                   const NewSurfaceCalibrationConfig& config, std::uint64_t seed) {
  const std::string learned_from = arguments.fitted_given
                                       ? printable(fmt::format("{}", fmt::join(calibration.objects, ", ")))
                                       : counted(calibration.objects.size(), "part") + " made up for it";
  return fmt::format(
      "Where rays meet new surface: what nextview calibrate --fit new-surface learned from {}, {} of each, seed {}.\n"
      "In turn with voxels of {} m, images {} pixels wide, range noise {} m.\n"
      "Use it with --config: nextview scan --config new_surface.toml",
      learned_from, counted(static_cast<std::uint64_t>(config.views), "view"), seed,
      fmt::join(config.resolutions, ", "), fmt::join(config.widths, ", "), fmt::join(config.range_noises, ", "));
}

void print(const NewSurfaceCalibration& calibration) {
  NewSurfaceModel model = calibration.model;
  fmt::print(
      "Learned from {}. Of the new surface {:.1f} % was in unmeasured voxels, {:.1f} % in free and {:.1f} % in "
      "occupied "
      "ones.\n\n",
      counted(calibration.objects.size(), "object"), 100.0 * calibration.found_unmeasured,
      100.0 * calibration.found_free, 100.0 * calibration.found_occupied);
  for (const Setting& s : settings(model))
    fmt::print("{:<40} {:>9.4f}  {}\n", s.key, *std::get<double*>(s.value), s.help);
}

}  // namespace

int fit_new_surface(const CalibrateArguments& arguments) {
  require_consistent(arguments);
  Configuration configuration = arguments.options.configuration();
  // The voxels, cameras and noises that are mixed are those for objects of this size.
  if (!configuration.sources.contains("object.longest_side")) configuration.object.longest_side = 0.5;
  const NewSurfaceCalibrationConfig config = fit_config(arguments, configuration);
  require_valid(configuration, config);
  OutputFolder out(arguments.out, inputs(arguments, configuration));
  require_no_session(arguments.out);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const std::vector<TrainingObject> learned_from = objects(arguments, configuration, progress, stop.token());
  const MadeFolder made = out.make();
  const NewSurfaceCalibration calibration =
      calibrate_new_surface(learned_from, configuration, config, progress, stop.token());
  progress.clear();
  print(calibration);
  out.begin("calibrate");
  write_file(out.claim("config.toml"), to_toml(configuration, out.path()));
  write_new_surface_calibration(calibration, config, configuration.seed,
                                remark(arguments, calibration, config, configuration.seed), out);
  fmt::print(
      "\n{}/\n  new_surface.toml    what was learned: nextview scan --config {} --out {}\n"
      "  calibration.json, config.toml   the numbers\n",
      printable(out.path().string()), shell_text(out.path() / "new_surface.toml"), shell_text(free_folder("out")));
  return 0;
}

}  // namespace nextview
