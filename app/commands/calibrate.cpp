#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/recorded_input.hpp"
#include "app/commands/shell_text.hpp"
#include "core/config/known_objects.hpp"
#include "core/export/map_calibration_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/offline/map_calibration.hpp"
#include "core/results/output_folder.hpp"
#include "core/view/candidate_views.hpp"
#include "ui/figures/calibration_figure.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  ConfigurationOptions options;
  RangeScanOptions range_scans;
  MapCalibrationConfig config;
  std::vector<std::string> fitted = {"bunny", "slotted_plate"};
  std::vector<std::string> held_out = {"gearbox", "slotted_housing"};
  bool held_out_given = false;
  std::vector<int> views = {4, 20};
  std::string out = "calibration";
  bool no_pictures = false;
};

/// Whether an input is finished scans; otherwise it is an object. A name that the program knows is the object, also
/// where there is a folder of this name (./NAME is the folder).
bool is_recorded(const std::string& input) {
  const auto names = known_objects();
  if (std::find(names.begin(), names.end(), input) != names.end()) return false;
  return fs::is_directory(input) || fs::path(input).extension() == ".txt";
}

/// The same for two spellings of one input.
fs::path identity(const std::string& input) {
  if (input.empty()) throw std::invalid_argument("calibrate: an input has no name");
  return fs::weakly_canonical(is_recorded(input) ? fs::path(input) : resolve_object(input));
}

/// The inputs to try the model on: none that is fitted to. Unless they were asked for, none if a fitted one is
/// recorded: it has a camera and voxels of its own.
std::vector<std::string> held_out_inputs(const CalibrateArguments& arguments) {
  const auto& fitted = arguments.fitted;
  if (!arguments.held_out_given && std::any_of(fitted.begin(), fitted.end(), is_recorded)) return {};
  std::vector<std::string> inputs;
  for (const std::string& input : arguments.held_out) {
    const auto same = [&](const std::string& other) { return identity(other) == identity(input); };
    if (std::none_of(fitted.begin(), fitted.end(), same))
      inputs.push_back(input);
    else if (arguments.held_out_given)
      fmt::print(stderr, "{}: is fitted to, and so not held out\n", printable(input));
  }
  return inputs;
}

/// Finished scans make one example, an object one for each number of views, spread evenly around it.
void add_examples(const CalibrateArguments& arguments, const std::string& input, bool held_out,
                  std::vector<CalibrationExample>& examples, const Progress& progress, std::stop_token stop) {
  if (is_recorded(input)) {
    examples.push_back({recorded_job(input, arguments.options, arguments.range_scans, progress, stop), held_out});
    return;
  }
  for (const int count : arguments.views) {
    Configuration configuration = arguments.options.configuration();
    configuration.object.file = input;
    CandidateViewsConfig around = configuration.views;
    around.layout = ViewLayout::fibonacci;
    around.count = count;
    CalibrationExample example{refinement_job(configuration, candidate_views(around, Vector3::Zero()), progress, stop),
                               held_out};
    example.job.name = fs::path(input).stem().string();
    examples.push_back(std::move(example));
  }
}

void print_model(const char* label, const InverseSensorModel& m) {
  fmt::print("{:<8} {:>8.4f} {:>8.4f} {:>10.4f} {:>10.4f} {:>10.3f} {:>10.3f}\n", label, m.hit, m.miss, m.clamp_min,
             m.clamp_max, m.hit_decay, m.miss_decay);
}

void print(const MapCalibration& calibration) {
  const Calibration& fit = calibration.fit;
  fmt::print(
      "Cross entropy to the Gibbs maps: {:.4f} before, {:.4f} after {} iterations of BFGS [nats per voxel].\n{}.\n\n",
      fit.cross_entropy_before, fit.cross_entropy, fit.descent.empty() ? 0 : fit.descent.size() - 1, fit.termination);
  fmt::print("{:<8} {:>8} {:>8} {:>10} {:>10} {:>10} {:>10}\n", "", "hit", "miss", "clamp_min", "clamp_max",
             "hit_decay", "miss_decay");
  print_model("before", calibration.before);
  print_model("after", fit.model);
  fmt::print("\n{:<24} {:>6}   {:>24}   {:>24}   {:>18}\n", "", "", "cross entropy [nats]", "log loss, surface* [nats]",
             "rows open** [%]");
  fmt::print("{:<24} {:>6}   {:>8}{:>8}{:>8}   {:>8}{:>8}{:>8}   {:>6}{:>6}{:>6}\n", "object", "views", "before",
             "after", "Gibbs", "before", "after", "Gibbs", "before", "after", "Gibbs");
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4f}", *value) : std::string("-");
  };
  const auto log_loss = [](const std::optional<MapScores>& s) {
    return s ? fmt::format("{:.3f}", s->touch_band.log_loss) : std::string("-");
  };
  const auto open = [](const std::optional<MapScores>& s) {
    const auto share = s ? s->openings.row_openness() : std::nullopt;
    return share ? fmt::format("{:.0f}", 100.0 * *share) : std::string("-");
  };
  for (const ExampleScores& e : calibration.examples)
    fmt::print("{:<24} {:>6}   {:>8}{:>8}{:>8}   {:>8}{:>8}{:>8}   {:>6}{:>6}{:>6}\n",
               printable(e.name) + (e.held_out ? "" : " (fitted)"), e.views, number(e.cross_entropy_before),
               number(e.cross_entropy_after), number(e.gibbs_entropy), log_loss(e.before), log_loss(e.after),
               log_loss(e.gibbs), open(e.before), open(e.after), open(e.gibbs));
  for (const ExampleScores& e : calibration.examples)
    if (!e.gibbs_stationary)
      fmt::print("! The Gibbs map of {} from {} is not stationary; raise gibbs.sweeps.\n", printable(e.name),
                 counted(e.views, "view"));
  fmt::print("* within 3 voxels of the true surface, touch truth. ** of slots and bores, centre truth.\n");
}

std::string remark(const CalibrateArguments& arguments, const MapCalibration& calibration, double resolution) {
  return fmt::format(
      "The inverse sensor model that nextview calibrate fitted to the Gibbs maps of {}: cross entropy {:.4f}, before\n"
      "{:.4f} nats per voxel. For voxels of {} m{}.\n"
      "Use it with --config: nextview scan --config sensor_model.toml",
      printable(fmt::format("{}", fmt::join(arguments.fitted, ", "))), calibration.fit.cross_entropy,
      calibration.fit.cross_entropy_before, resolution,
      is_recorded(arguments.fitted.front()) && !fs::exists(fs::path(arguments.fitted.front()) / "config.toml")
          ? ""
          : " and the sensor of the config.toml beside it");
}

/// What can be told before views are taken: the objects, the finished scans and the configuration files.
std::vector<InputFile> named_inputs(const CalibrateArguments& arguments, const std::vector<std::string>& held_out) {
  std::vector<InputFile> inputs;
  for (const auto& [names, what] : {std::pair{&arguments.fitted, "what is fitted to"}, {&held_out, "held out"}})
    for (const std::string& name : *names) inputs.push_back({identity(name), what});
  Configuration configuration;
  arguments.options.apply_to(configuration);
  for (const fs::path& file : configuration.read_from) inputs.push_back({file, "read as configuration"});
  return inputs;
}

/// Everything that the examples were read from, once they were.
OutputFolder output_folder(const CalibrateArguments& arguments, std::span<const CalibrationExample> examples) {
  std::vector<InputFile> inputs;
  std::set<std::string> notices;  // an object may be in several examples
  for (const CalibrationExample& example : examples) {
    inputs.insert(inputs.end(), example.job.inputs.begin(), example.job.inputs.end());
    notices.insert(example.job.notices.begin(), example.job.notices.end());
  }
  for (const std::string& notice : notices) fmt::print(stderr, "notice: {}\n", notice);
  return OutputFolder(arguments.out, inputs);
}

int run(const CalibrateArguments& arguments) {
  if (arguments.fitted.empty()) throw std::invalid_argument("calibrate: there is nothing to fit to");
  const std::vector<std::string> held_out = held_out_inputs(arguments);
  [[maybe_unused]] const OutputFolder at_first_sight(arguments.out, named_inputs(arguments, held_out));
  const StopOnInterrupt stop;
  const ProgressLine progress;
  std::vector<CalibrationExample> examples;
  for (const std::string& input : arguments.fitted)
    add_examples(arguments, input, false, examples, progress, stop.token());
  for (const std::string& input : held_out) add_examples(arguments, input, true, examples, progress, stop.token());
  progress.clear();
  OutputFolder out = output_folder(arguments, examples);
  out.make();
  const double resolution = examples.front().job.grid.resolution;
  const Configuration configuration = examples.front().job.configuration;
  const MapCalibration calibration = calibrate_map(std::move(examples), arguments.config, progress, stop.token());
  progress.clear();
  print(calibration);
  out.begin("calibrate");
  write_file(out.claim("config.toml"), to_toml(configuration, out.path()));
  write_map_calibration(calibration, remark(arguments, calibration, resolution), out);
  if (!arguments.no_pictures) write_png(draw_calibration_figure(calibration), out.claim("calibration.png"));
  fmt::print(
      "\n{}/\n  sensor_model.toml   the fitted model: nextview scan --config {} --out {}\n"
      "{}  calibration.json, descent.csv, scores.csv, config.toml   the numbers\n",
      printable(out.path().string()), shell_text(out.path() / "sensor_model.toml"), shell_text(free_folder("out")),
      arguments.no_pictures ? "" : "  calibration.png     the picture\n");
  return 0;
}

}  // namespace

void add_calibrate_command(CLI::App& program) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* app = program.add_subcommand(
      "calibrate", "Fit the conventional map's sensor model to Gibbs maps, and try it on objects that it has not seen");
  app->add_option("INPUT", arguments->fitted, "objects to fit to: as for `scan`; or finished scans: as for `refine`")
      ->capture_default_str();
  app->add_option_function<std::vector<std::string>>(
         "--held-out",
         [arguments](const std::vector<std::string>& inputs) {
           arguments->held_out = inputs;
           arguments->held_out_given = true;
         },
         "the same, to try the fitted model on, separated by commas; default gearbox and slotted_housing, or, if an "
         "INPUT is finished scans, none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("INPUT");
  app->add_option("--views", arguments->views, "of each object, so many views, spread evenly around it")
      ->capture_default_str()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 100));
  app->add_flag("--range-dependent", arguments->config.fit.range_dependent,
                "let the update terms depend on the range (map.hit_decay, map.miss_decay)");
  app->add_flag_callback(
      "--keep-clamps", [arguments] { arguments->config.fit.clamps = false; }, "leave the clamps as they are");
  app->add_option("--band", arguments->config.band,
                  "fit to voxels at most so many from the surface, as the Gibbs map has it; 0: to all")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  app->add_option("--out", arguments->out, "folder for the results")->capture_default_str()->type_name("DIR");
  app->add_flag("--no-pictures", arguments->no_pictures, "write no pictures: faster");
  arguments->range_scans.add_to(*app);
  arguments->options.add_settings_to(
      *app, {"sensor.", "cloud.", "map.", "gibbs.", "views.radius", "object.longest_side", "evaluation.", "seed"});
  app->footer(
      "Examples:\n  nextview calibrate --out calibration\n"
      "  nextview calibrate bunny part.stl --held-out gearbox,slotted_plate --views 4,10,20 --sensor narrow\n"
      "  nextview scan --config calibration/sensor_model.toml --out out");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
