#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/recorded_input.hpp"
#include "app/commands/surface_output.hpp"
#include "core/export/diagnostics_text.hpp"
#include "core/export/refinement_files.hpp"
#include "core/export/scan_files.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/offline/refinement.hpp"
#include "core/session/saved_session.hpp"
#include "ui/figures/refinement_figure.hpp"
#include "ui/figures/sensor_model_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

struct RefineArguments {
  ConfigurationOptions options;
  std::string input, out = "refined";
  RangeScanOptions range_scans;
  bool no_pictures = false, no_surfaces = false;
};

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f}", 100.0 * *share) : std::string("-");
}

/// The numbers before and after, for the terminal and the picture.
std::vector<RefinementNumber> numbers(const Refinement& r) {
  std::vector<RefinementNumber> rows;
  const auto add = [&](const char* label, const std::string& before, const std::string& after, const char* unit) {
    rows.push_back({label, before, after, unit});
  };
  if (r.scores_before) {
    const MapScores &a = *r.scores_before, &b = *r.scores_after;
    const auto number = [](double x) { return fmt::format("{:.3f}", x); };
    add("log loss near the surface, touch", number(a.touch_band.log_loss), number(b.touch_band.log_loss), "nats");
    add("log loss near the surface, centre", number(a.centre_band.log_loss), number(b.centre_band.log_loss), "nats");
    add("log loss, all visited, touch", number(a.touch_visited.log_loss), number(b.touch_visited.log_loss), "nats");
    add("D_KL, all visited, touch", fmt::format("{:.1f}", a.touch_visited.divergence / 1e3),
        fmt::format("{:.1f}", b.touch_visited.divergence / 1e3), "knats");
    add("surface recall", percent(a.surface_recall), percent(b.surface_recall), "%");
    if (a.openings.rows > 0) {
      add("open rows of slots and bores", percent(a.openings.row_openness()), percent(b.openings.row_openness()), "%");
      add("rows open through solid walls", percent(a.openings.leaks()), percent(b.openings.leaks()), "%");
    }
  }
  const auto count = [](const VoxelBricks& voxels, auto which) {
    return fmt::format("{}", std::count_if(voxels.begin(), voxels.end(), which));
  };
  const auto occupied = [](const Voxel& v) { return v.measured && v.probability >= 0.5f; };
  const auto unsure = [](const Voxel& v) { return v.measured && v.voxel_class == VoxelClass::unknown; };
  const auto measured = [](const Voxel& v) { return v.measured; };
  add("voxels measured, informed", count(r.conventional.voxels(), measured), count(r.refined, measured), "");
  add("of these occupied", count(r.conventional.voxels(), occupied), count(r.refined, occupied), "");
  add("of these unknown", count(r.conventional.voxels(), unsure), count(r.refined, unsure), "");
  return rows;
}

std::size_t best(const std::vector<double>& gains) {
  return static_cast<std::size_t>(std::max_element(gains.begin(), gains.end()) - gains.begin());
}

void print(const RefinementJob& job, const Refinement& r) {
  const SamplerDiagnostics& d = r.posterior.diagnostics;
  fmt::print("{}: {}, {} merged to {}, {} informed; {:.1f} s for the lists, {:.1f} s for the sweeps\n",
             printable(job.name), counted(job.scans.size(), "view"), counted(d.measured_rays, "ray"), d.merged_rays,
             counted(d.informed_voxels, "voxel"), d.build_seconds, d.sample_seconds);
  fmt::print("model {}: {}\n\n", name(job.sampler.model.kind), diagnostics_line(d));
  fmt::print("{:<36} {:>14} {:>14}\n", "", "conventional", "Gibbs");
  for (const RefinementNumber& n : numbers(r))
    fmt::print("{:<36} {:>14} {:>14} {}\n", n.label, n.before, n.after, n.unit);
  if (!r.gains_after.empty())
    fmt::print(
        "\nThe view with the most entropy in sight: {} on the conventional map, {} on the Gibbs map; the ranks of "
        "all {} correlate {:.2f}.\n",
        best(r.gains_before), best(r.gains_after), r.gains_after.size(), r.rank_correlation);
}

void write_pictures(const RefinementJob& job, const Refinement& r, OutputFolder& out, RenderTarget& target) {
  RefinementPicture picture;
  picture.title = fmt::format("{} refined", job.name);
  picture.remark = fmt::format("{}, model {}", counted(job.scans.size(), "view"), name(job.sampler.model.kind));
  picture.caption = diagnostics_line(r.posterior.diagnostics);
  picture.grid = job.grid;
  const std::vector<Voxel> conventional = r.conventional.voxels().dense(), gibbs = r.refined.dense();
  picture.conventional = conventional;
  picture.gibbs = gibbs;
  picture.diagnostics = r.posterior.diagnostics;
  if (job.truth) {
    picture.object = job.truth->mesh.get();
    picture.openings = job.truth->openings;
    picture.numbers_note = "near: within 3 voxels of the surface; visited by noise-free rays";
  }
  picture.numbers = numbers(r);
  write_png(draw_refinement_figure(target, picture), out.claim("refinement.png"));
  const double max_range = job.scans.front().max_range;
  write_png(draw_sensor_model_figure(target, {job.sampler.model, job.grid.resolution, 0.6 * max_range, max_range}),
            out.claim("sensor_models.png"));
}

int run(const RefineArguments& arguments) {
  // That much can be told before the views are taken again.
  OutputFolder out(arguments.out, std::vector<InputFile>{{arguments.input, "what is refined"}});
  require_no_session(arguments.out);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const RefinementJob job =
      recorded_job(arguments.input, arguments.options, arguments.range_scans, progress, stop.token());
  progress.clear();
  for (const std::string& notice : job.notices) fmt::print(stderr, "notice: {}\n", notice);
  out = OutputFolder(arguments.out, job.inputs);
  const MadeFolder made = out.make();
  const Refinement refinement = refine(job, progress, stop.token());
  progress.clear();
  print(job, refinement);
  out.begin("refine", job.object);
  write_refinement(job, refinement, out);
  std::optional<OffscreenTarget> target;  // one for all: what it takes to draw in it is made once
  if (!arguments.no_pictures) write_pictures(job, refinement, out, target.emplace(1600, 1000));
  std::string surface_files;
  if (!arguments.no_surfaces) {
    const auto surfaces = scan_surfaces(job, refinement, progress, stop.token());
    progress.clear();
    surface_files = write_and_print_surfaces(surfaces, job.name, job.scans.size(), out, target ? &*target : nullptr);
  }
  fmt::print("\n{}/\n", printable(out.path().string()));
  if (!arguments.no_pictures) fmt::print("  refinement.png, sensor_models.png\n");
  fmt::print("{}", surface_files);
  fmt::print(
      "  posterior.ot, posterior.bt, conventional.ot   the maps (OctoMap)\n"
      "  metrics.json, scores.csv, trace.csv, timings.csv, config.toml   the numbers\n");
  return stop.token().stop_requested() ? exit_stopped : 0;
}

}  // namespace

void add_refine_command(CLI::App& program) {
  auto arguments = std::make_shared<RefineArguments>();
  CLI::App* app = program.add_subcommand(
      "refine", "Refine the map of finished scans by Gibbs sampling: the posterior without independence assumptions");
  app->add_option("INPUT", arguments->input,
                  "folder that `scan` wrote, folder of range scans (Stanford's: .conf and .ply), or scene file")
      ->transform(kept_session())
      ->required();
  arguments->options.add_settings_to(*app, {"gibbs.", "seed"});
  app->add_option("--out", arguments->out, "folder for the results; those of an earlier run are replaced")
      ->capture_default_str()
      ->type_name("DIR");
  app->add_flag("--no-pictures", arguments->no_pictures, "write no pictures: faster");
  app->add_flag("--no-surfaces", arguments->no_surfaces, "make no surfaces: faster");
  arguments->range_scans.add_to(*app);
  app->footer(
      "Examples:\n  nextview refine out --out refined\n  nextview refine out --gibbs.model beam --out beam\n"
      "  nextview refine stanford_bunny --out bunny");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
