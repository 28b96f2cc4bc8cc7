#include "app/commands/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "core/config/known_objects.hpp"
#include "core/sensor/recorded_scans.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct Fit {
  std::string name;
  int (*run)(const CalibrateArguments&);
  std::vector<std::string> options_of_others;  ///< that it has no use for; of settings how they begin
};
const std::vector<Fit>& fits() {
  static const std::vector<Fit> all = {
      {"sensor-model", fit_sensor_model, {"--parts"}},
      {"new-surface",
       fit_new_surface,
       {"--held-out", "--range-dependent", "--keep-clamps", "--band", "--voxel", "--stand-off", "--gibbs."}}};
  return all;
}
std::vector<std::string> fit_names() {
  std::vector<std::string> names;
  for (const Fit& fit : fits()) names.push_back(fit.name);
  return names;
}

/// Nothing that was asked for is left out in silence.
void require_options_of(const Fit& fit, const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const auto is_it = [&](const std::string& other) {
      return other.ends_with('.') ? name.starts_with(other) : name == other;
    };
    if (option->count() > 0 && std::ranges::any_of(fit.options_of_others, is_it))
      throw std::invalid_argument(fmt::format("{} has no meaning with --fit {}", name, fit.name));
  }
}

int run(CalibrateArguments& arguments, const std::string& fit_name, const CLI::App& app) {
  const Fit& fit = *std::ranges::find(fits(), fit_name, &Fit::name);
  require_options_of(fit, app);
  arguments.fitted_given = app.count("INPUT") > 0;
  arguments.held_out_given = app.count("--held-out") > 0;
  arguments.views_given = app.count("--views") > 0;
  arguments.parts_given = app.count("--parts") > 0;
  return fit.run(arguments);
}

void add_options_of_sensor_model(CLI::App& app, CalibrateArguments& arguments) {
  app.add_option("--held-out", arguments.held_out,
                 "the same, to try the fitted model on, separated by commas; default gearbox and slotted_housing, or, "
                 "if an INPUT is finished scans, none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("INPUT");
  app.add_flag("--range-dependent", arguments.config.fit.range_dependent,
               "let the update terms depend on the range (map.hit_decay, map.miss_decay)");
  app.add_flag_callback(
      "--keep-clamps", [&arguments] { arguments.config.fit.clamps = false; }, "leave the clamps as they are");
  app.add_option("--band", arguments.config.band,
                 "fit to voxels at most so many from the surface, as the Gibbs map has it; 0: to all")
      ->capture_default_str()
      ->check(within(0, 100));
}

}  // namespace

bool is_recorded(const std::string& input) {
  const auto names = known_objects();
  if (std::find(names.begin(), names.end(), input) != names.end()) return false;
  return fs::is_directory(input) || is_scene_file(input);
}

fs::path input_path(const std::string& input) {
  if (input.empty()) throw std::invalid_argument("calibrate: an input has no name");
  return fs::weakly_canonical(is_recorded(input) ? fs::path(input) : resolve_object(input));
}

void add_calibrate_command(CLI::App& program) {
  auto arguments = std::make_shared<CalibrateArguments>();
  auto fit = std::make_shared<std::string>(fits().front().name);
  CLI::App* app = program.add_subcommand("calibrate",
                                         "Fit the conventional map's sensor model to Gibbs maps, and try it on objects "
                                         "that it has not seen; or learn from "
                                         "simulated scans where new surface is to be expected");
  app->add_option("INPUT", arguments->fitted,
                  "objects to fit to: as for `scan`; or, for the sensor model, finished scans: as for `refine`. For "
                  "new surface by default parts made up for it")
      ->transform(kept_session())
      ->capture_default_str();
  app->add_option("--fit", *fit, "the sensor model (map.hit, …), or what the gain new-surface expects (new_surface.…)")
      ->capture_default_str()
      ->check(one_of(fit_names()));
  app->add_option("--views", arguments->views,
                  "of each object, so many views, spread evenly around it; for new surface one number, default 10, "
                  "half of them at random")
      ->capture_default_str()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(within(1, 100));
  app->add_option("--parts", arguments->parts, "new surface: so many parts to make up where there is no INPUT")
      ->capture_default_str()
      ->check(within(1, 1000));
  add_options_of_sensor_model(*app, *arguments);
  app->add_option("--out", arguments->out, "folder for the results; those of an earlier run are replaced")
      ->capture_default_str()
      ->type_name("DIR");
  app->add_flag("--no-pictures", arguments->no_pictures, "write no pictures: faster");
  arguments->range_scans.add_to(*app);
  arguments->options.add_settings_to(
      *app, {"sensor.", "cloud.", "map.", "gibbs.", "views.radius", "object.longest_side", "evaluation.", "seed"});
  app->footer(
      "Examples:\n  nextview calibrate --out calibration\n"
      "  nextview calibrate bunny part.stl --held-out gearbox,slotted_plate --views 4,10,20 --sensor narrow\n"
      "  nextview scan --config calibration/sensor_model.toml --out out\n"
      "  nextview calibrate --fit new-surface --resolution 0.005 --out learned\n"
      "  nextview scan --config learned/new_surface.toml --out out");
  app->callback([arguments, fit, app] { throw CLI::RuntimeError(run(*arguments, *fit, *app)); });
}

}  // namespace nextview
