#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numbers>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/scanner.hpp"
#include "app/commands/shell_text.hpp"
#include "app/commands/surface_output.hpp"
#include "core/config/input_files.hpp"
#include "core/config/object_lengths.hpp"
#include "core/export/scan_files.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/session/setup_warnings.hpp"
#include "core/setting/length_text.hpp"
#include "ui/figures/session_figure.hpp"

namespace nextview {
namespace {

constexpr int most_failures = 3;  // of a live scanner, one after the other

struct ScanArguments {
  ConfigurationOptions options;
  std::string out = "out";
  bool no_pictures = false, no_surfaces = false;
  ScannerOptions scanner;
};

std::string object_text(const Session& session) {
  const LengthUnit unit = session.object().unit;
  std::string text = fmt::format(
      "{}: {}{}; {}\n{}\n", printable(session.object_file().filename().string()), size_text(*session.mesh()),
      unit == LengthUnit::automatic ? "" : fmt::format(" (its unit taken as {})", name(unit)),
      session.object_topology().summary(), lengths_text(session.configuration()));
  for (const std::string& note : session.notes()) text += fmt::format("  {}\n", printable(note));
  return text;
}

/// What was recorded, what was guessed of it, and how it lies on the mesh that it is compared with.
std::string recording_text(const Session& session) {
  const Recording& recording = *session.recording();
  const Configuration& c = session.configuration();
  std::string text =
      fmt::format("{}: {} ({}), {} x {} pixels; voxels {}, region {}, d_reg {}\n", printable(session.name()),
                  counted(recording.frames.size(), "recorded frame"), recording.format, recording.camera.width,
                  recording.camera.height, length_text(c.map.resolution), size_text(session.setup().region.box()),
                  length_text(c.evaluation.d_reg));
  for (const std::string& note : session.notes()) text += fmt::format("  {}\n", printable(note));
  return text;
}

void print_head(const Session& session) {
  const Configuration& c = session.configuration();
  const std::string unit = session.planner().unit();
  fmt::print("{}", session.recording() ? recording_text(session)
                   : session.mesh()    ? object_text(session)
                                       : fmt::format("{}: {}\n", printable(session.name()), lengths_text(c)));
  fmt::print("{}, ranked by {}{} ({} semantics)\n\n",
             counted(session.candidates().size(), session.recording() ? "frame to choose from" : "candidate view",
                     session.recording() ? "frames to choose from" : "candidate views"),
             c.planner.gain, unit.empty() ? "" : fmt::format(" [{}]", unit),
             c.planner.semantics == Semantics::published ? "published" : "reference");
  fmt::print("{:>4} {:>5} {:>10} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "step", "view", "gain", "moved", "hits",
             "new", "coverage", "entropy", "log loss", "seconds");
  fmt::print("{:>4} {:>5} {:>10} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "", "", unit, "m", "", "cm²",
             session.recording() ? "% of all" : "% visible", "kbit", "nats*", "");
}

std::string registration_text(const ScanRegistration& r) {
  if (!r.reliable) return "not registered: " + r.why_not;
  return fmt::format("registered: {} and {:.2g} degrees off the scans before, {:.0f} % of it lie on them",
                     length_text(r.shift), r.rotation * 180.0 / std::numbers::pi, 100.0 * r.overlap);
}

/// A share of the surface, and how good the map is, where they are known.
std::string coverage_text(const Session& session, const StepRecord& r) {
  if (r.coverage_recorded) return fmt::format("{:.1f}", 100.0 * *r.coverage_recorded);
  return session.known_object() ? fmt::format("{:.1f}", 100.0 * r.coverage_visible) : "-";
}

void print_step(const Session& session, const StepRecord& r) {
  const StageSeconds& s = r.seconds;
  fmt::print("{:>4} {:>5} {:>10.5g} {:>8.2f} {:>8} {:>9.0f} {:>9} {:>9.1f} {:>9} {:>8.2f}\n", r.step,
             r.view < 0 ? "start" : fmt::format("{}", r.view), r.gain, r.motion.distance, r.hits, r.new_surface,
             coverage_text(session, r), r.entropy / 1e3,
             session.known_object() ? fmt::format("{:.3f}", r.quality_near_surface.log_loss) : "-",
             s.sense + s.clean + s.insert + s.refine + s.evaluate + s.score);
  if (r.refinement) {
    const auto view = [](const auto& v) { return v ? fmt::format("{}", *v) : std::string("none"); };
    fmt::print("       refined: log loss {:.3f}; next view {} ({} without refinement), ranks correlate {:.2f}\n",
               r.refinement->quality_near_surface.log_loss, view(r.ranking.best), view(r.refinement->conventional_best),
               r.refinement->rank_correlation);
  }
  if (r.registration) fmt::print("       {}\n", registration_text(*r.registration));
  if (!r.ranking.reason.empty()) fmt::print("       next: {}\n", r.ranking.reason);
  if (!r.ranking.degenerate.empty()) fmt::print("       ! no ranking: {}\n", r.ranking.degenerate);
  std::fflush(stdout);
}

/// How soon this order showed what all frames do, beside others.
void print_orders(const Session& session) {
  const CoverageByOrder orders =
      session.setup().recorded->compare_orders(frames_taken(session.state().known), session.configuration().seed);
  const auto views_to = [](const std::vector<double>& coverage, double share) {
    const auto there = std::ranges::find_if(coverage, [&](double c) { return c >= share; });
    return there == coverage.end() ? std::string("-") : fmt::format("{}", there - coverage.begin() + 1);
  };
  fmt::print("Coverage: of what all frames show, within d_reg = {}. Views to reach it:\n{:>12} {:>8} {:>10} {:>8}\n",
             length_text(session.setup().recorded->d_reg()), "", "planned", "recorded", "random");
  for (const double share : {0.9, 0.95, 0.99})
    fmt::print("{:>10.0f} % {:>8} {:>10} {:>8}\n", 100.0 * share, views_to(orders.planned, share),
               views_to(orders.recorded, share), views_to(orders.random, share));
}

void print_end(const Session& session) {
  fmt::print("\nFinished: {}.\n", session.finished().empty() ? "stopped by the user" : session.finished());
  if (session.records().empty()) return;
  const StepRecord& last = session.records().back();
  if (last.surface_left && session.known_object() && !session.recording())
    fmt::print("Surface expected to be left: {:.2g} %; truly left of what the candidates can see: {:.2g} %.\n",
               100.0 * *last.surface_left, 100.0 * (1.0 - last.coverage_visible));
  if (session.known_object())
    fmt::print(
        "* within 3 voxels of the surface. Coverage: of the surface that some candidate can see, at d_reg = {:g} mm; "
        "of all the\n"
        "  surface {:.1f} %; at the paper's 0.5 mm {:.1f} %.\n",
        1e3 * session.configuration().evaluation.d_reg, 100.0 * last.coverage, 100.0 * last.coverage_paper);
  if (session.setup().recorded) print_orders(session);
  if (last.coverage_any_pose)
    fmt::print("  Of the surface that any pose could see {:.1f} %.\n", 100.0 * *last.coverage_any_pose);
}

void print_files(const Session& session, const std::filesystem::path& out, bool pictures, const std::string& surfaces) {
  fmt::print("\n{}/\n", printable(out.string()));
  if (pictures) fmt::print("  step_01.png …   a picture of each step: views and scores, the map, the curves\n");
  fmt::print(
      "  map.ot, map.bt  the occupancy map (OctoMap: full, binary)\n"
      "{}  cloud.ply       the cleaned point cloud\n{}"
      "  steps.csv, scores.csv, views.csv, timings.csv, metrics.json   the numbers\n{}"
      "  config.toml     the configuration; this repeats the scan:\n"
      "                  nextview scan --config {}{} --out {}\n",
      session.refinement() ? "  posterior.ot    the Gibbs map; refinement.csv: what each refinement did\n" : "",
      surfaces,
      session.recording() ? "  orders.csv      coverage by views: this order, the recorded one, random ones\n" : "",
      shell_text(out / "config.toml"), session.configuration().driver.name.empty() ? "" : " --driver …",
      shell_text(free_folder(out)));
}

/// Takes the views, one after the other, with a picture of each. A live scanner that fails is reached again.
void take_views(Session& session, Scanner* scanner, OutputFolder& out, bool pictures, const ProgressLine& progress,
                const std::stop_token& stop) {
  std::unique_ptr<SessionFigure> figure;
  if (pictures) figure = std::make_unique<SessionFigure>();
  int failures = 0;  // one after the other
  while (session.finished().empty()) {
    try {
      if (!session.step(progress, stop)) break;
    } catch (const std::runtime_error& error) {
      progress.clear();
      if (!scanner || ++failures > most_failures) throw;
      fmt::print(stderr, "{}\n", printable(error.what()));
      scanner->reconnect(stop);
      continue;
    }
    failures = 0;
    progress.clear();
    print_step(session, session.records().back());
    if (figure) figure->write(session, out.claim(fmt::format("step_{:02}.png", session.records().size())));
  }
}

void write_results(const Session& session, const ScanArguments& arguments, OutputFolder& out,
                   const ProgressLine& progress, const std::stop_token& stop) {
  progress(1.0, "writing the files");
  write_scan(session, out);
  std::string surface_files;
  if (!arguments.no_surfaces && !session.records().empty()) {
    const auto surfaces = scan_surfaces(session, progress, stop);
    progress.clear();
    surface_files =
        write_and_print_surfaces(surfaces, session.name(), session.records().size(), out, !arguments.no_pictures);
  }
  print_end(session);
  print_files(session, out.path(), !arguments.no_pictures, surface_files);
}

int run(const ScanArguments& arguments) {
  Configuration configuration = arguments.options.configuration();
  OutputFolder out(arguments.out, input_files(configuration));
  const StopOnInterrupt stop;
  const ProgressLine progress;
  std::optional<Scanner> scanner;
  if (arguments.scanner.wanted()) scanner.emplace(arguments.scanner, configuration, stop.token());
  SessionParts parts = scanner ? scanner->parts(configuration) : SessionParts{};
  Session session(configuration, std::move(parts), progress, stop.token());
  progress.clear();
  if (!session.finished().empty()) throw std::invalid_argument(session.name() + ": " + session.finished());
  print_head(session);
  if (!session.recording() && session.mesh())
    for (const std::string& warning : setup_warnings(session.configuration(), *session.mesh(), session.candidates()))
      fmt::print(stderr, "warning: {}\n", warning);
  out.begin("scan", session.object_file().empty() ? std::nullopt : std::optional(session.object_file()));
  std::string failure;
  try {
    take_views(session, scanner ? &*scanner : nullptr, out, !arguments.no_pictures, progress, stop.token());
  } catch (const std::runtime_error& error) {
    if (session.records().empty()) throw;
    failure = error.what();  // what was taken is written all the same
  }
  write_results(session, arguments, out, progress, stop.token());
  if (!failure.empty()) throw std::runtime_error(failure);
  return session.finished().empty() || stop.token().stop_requested() ? exit_stopped : 0;
}

}  // namespace

void add_scan_command(CLI::App& program) {
  auto arguments = std::make_shared<ScanArguments>();
  CLI::App* app =
      program.add_subcommand("scan", "Scan an object without a display: pictures, map, cloud, surfaces and numbers");
  arguments->options.add_to(*app);
  arguments->scanner.add_to(*app);
  app->add_option("--out", arguments->out, "folder for the results")->capture_default_str()->type_name("DIR");
  app->add_flag("--no-pictures", arguments->no_pictures, "write no pictures: faster");
  app->add_flag("--no-surfaces", arguments->no_surfaces, "make no surfaces: faster");
  app->footer(
      "Examples:\n  nextview scan --out out\n  nextview scan bunny.ply --gain rear-side-entropy --views 10 --seed 7 "
      "--out bunny\n"
      "  nextview scan --recorded frames --out recorded\n"
      "  nextview scan --driver \"python3 turntable.py scans\" --map.region \"-0.1 -0.1 0 0.1 0.1 0.2\" --out part\n"
      "  nextview scan --config out/config.toml --sensor.range_noise 0.005 --out noisy");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
