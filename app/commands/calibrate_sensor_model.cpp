#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "app/commands/calibrate.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/shell_text.hpp"
#include "core/export/map_calibration_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/offline/map_calibration.hpp"
#include "core/progress/part.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/saved_session.hpp"
#include "core/session/session_parts.hpp"
#include "core/view/candidate_views.hpp"
#include "ui/figures/calibration_figure.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// The inputs to try the model on: none that is fitted to. Unless they were asked for, none if a fitted one is
/// recorded: it has a camera and voxels of its own.
std::vector<std::string> held_out_inputs(const CalibrateArguments& arguments) {
  const auto& fitted = arguments.fitted;
  if (!arguments.held_out_given && std::any_of(fitted.begin(), fitted.end(), is_recorded)) return {};
  std::vector<std::string> inputs;
  for (const std::string& input : arguments.held_out) {
    const auto same = [&](const std::string& other) { return input_path(other) == input_path(input); };
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
  for (std::size_t k = 0; k < arguments.views.size(); ++k) {
    const int count = arguments.views[k];
    const auto done = [&](std::size_t jobs) { return double(jobs) / double(arguments.views.size()); };
    Configuration configuration = arguments.options.configuration();
    configuration.object.file = input;
    Configuration fitted = configuration;
    load_object(fitted, stop);  // the views' distance follows from its size
    CandidateViewsConfig around = fitted.views;
    around.layout = ViewLayout::fibonacci;
    around.count = count;
    CalibrationExample example{refinement_job(configuration, candidate_views(around, view_target(fitted)),
                                              part(progress, done(k), done(k + 1)), stop),
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
    for (const std::string& name : *names) inputs.push_back({input_path(name), what});
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

}  // namespace

int fit_sensor_model(const CalibrateArguments& arguments) {
  if (arguments.fitted.empty()) throw std::invalid_argument("calibrate: there is nothing to fit to");
  const std::vector<std::string> held_out = held_out_inputs(arguments);
  if (arguments.views_given && std::ranges::all_of(arguments.fitted, is_recorded) &&
      std::ranges::all_of(held_out, is_recorded))
    throw std::invalid_argument("calibrate: --views is of objects: finished scans keep the views that they have");
  [[maybe_unused]] const OutputFolder at_first_sight(arguments.out, named_inputs(arguments, held_out));
  require_no_session(arguments.out);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  std::vector<CalibrationExample> examples;
  constexpr double of_examples = 0.3;
  std::size_t begun = 0;
  const auto of_next = [&] {
    const double each = of_examples / double(arguments.fitted.size() + held_out.size());
    const double begin = each * double(begun++);
    return part(progress, begin, begin + each);
  };
  for (const std::string& input : arguments.fitted)
    add_examples(arguments, input, false, examples, of_next(), stop.token());
  for (const std::string& input : held_out) add_examples(arguments, input, true, examples, of_next(), stop.token());
  progress.clear();
  OutputFolder out = output_folder(arguments, examples);
  const MadeFolder made = out.make();
  const double resolution = examples.front().job.grid.resolution;
  const Configuration configuration = examples.front().job.configuration;
  const MapCalibration calibration =
      calibrate_map(std::move(examples), arguments.config, part(progress, of_examples, 1.0), stop.token());
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

}  // namespace nextview
