#include "app/commands/scan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "app/commands/progress.hpp"
#include "app/commands/shell_text.hpp"
#include "core/config/object_lengths.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/planner/policy.hpp"
#include "core/planner/way_text.hpp"
#include "core/results/output_folder.hpp"
#include "core/setting/length_text.hpp"
#include "core/setting/percent_text.hpp"

namespace nextview {
namespace {

/// Objects are seldom so large, and often without a unit.
std::string unit_text(const PlacedMesh& object, double longest) {
  constexpr double large = 3.0;  // [m]
  if (object.unit == LengthUnit::automatic) return "";
  if (object.is_unit_guessed && object.unit == LengthUnit::metres && longest > large)
    return " (no unit in the file: metres; --object.unit mm if it is millimetres)";
  return fmt::format(" (its unit taken as {})", name(object.unit));
}

std::string object_text(const Session& session) {
  const Eigen::AlignedBox3d box = session.mesh()->bounding_box();
  const double longest = box.sizes().maxCoeff();
  std::string text = fmt::format("{}: {}{}; {}\n{}\n", printable(session.object_file().filename().string()),
                                 size_text(box), unit_text(session.object(), longest),
                                 session.object_topology().summary(), lengths_text(session.configuration()));
  if (const std::string moved = centring_text(session.object().placement, longest); !moved.empty())
    text += fmt::format("  {}, in what is written, too; object.centred false keeps the file's\n", moved);
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

std::string registration_text(const ScanRegistration& r) {
  if (!r.reliable) return "not registered: " + r.why_not;
  return fmt::format("registered: {} and {:.2g} degrees off the scans before, {:.0f} % of it lies on them",
                     length_text(r.shift), r.rotation * 180.0 / std::numbers::pi, 100.0 * r.overlap);
}

/// A share of the surface, and how good the map is, where they are known.
std::string coverage_text(const Session& session, const StepRecord& r) {
  if (r.coverage_recorded) return fmt::format("{:.1f}", 100.0 * *r.coverage_recorded);
  return session.known_object() ? fmt::format("{:.1f}", 100.0 * r.coverage_visible) : "-";
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

}  // namespace

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
  fmt::print("{:>4} {:>5} {:>10} {:>8} {:>8} {:>9} {:>9} {:>14} {:>9} {:>8}\n", "step", "view", "gain", "moved", "hits",
             "new", "coverage", "unmeasured", "log loss", "seconds");
  fmt::print("{:>4} {:>5} {:>10} {:>8} {:>8} {:>9} {:>9} {:>14} {:>9} {:>8}\n", "", "", unit,
             way_unit(session.state().known.map.grid()).name, "", "cm²", session.recording() ? "% shown" : "% visible",
             "entropy Mbit", "nats*", "");
}

void print_step(const Session& session, const StepRecord& r) {
  const StageSeconds& s = r.seconds;
  std::string gain = fmt::format("{:.5g}", r.gain);
  if (!r.gain_unit.empty() && r.gain_unit != session.planner().unit()) gain += " " + r.gain_unit;
  fmt::print("{:>4} {:>5} {:>10} {:>8} {:>8} {:>9} {:>9} {:>14.3f} {:>9} {:>8.2f}\n", r.step,
             r.view < 0 ? "start" : fmt::format("{}", r.view), gain,
             way_number(r.motion.distance, way_unit(session.state().known.map.grid())), r.hits,
             short_text(r.new_surface), coverage_text(session, r), r.entropy / 1e6,
             session.known_object() ? fmt::format("{:.3f}", r.quality_near_surface.log_loss) : "-",
             s.sense + s.clean + s.insert + s.refine + s.evaluate + s.score);
  if (r.refinement) {
    const auto view = [](const auto& v) { return v ? fmt::format("{}", *v) : std::string("none"); };
    fmt::print("       refined: log loss {:.3f}; next view {} ({} without refinement), ranks correlate {:.2f}\n",
               r.refinement->quality_near_surface.log_loss, view(r.ranking.best), view(r.refinement->conventional_best),
               r.refinement->rank_correlation);
  }
  if (r.registration) fmt::print("       {}\n", registration_text(*r.registration));
  if (r.hits == 0) fmt::print("       ! no pixel met a surface\n");
  if (!r.ranking.reason.empty()) fmt::print("       next: {}\n", r.ranking.reason);
  if (!r.ranking.degenerate.empty()) fmt::print("       ! no ranking: {}\n", r.ranking.degenerate);
  flush_output();
}

void print_end(const Session& session, const std::string& failure) {
  if (!failure.empty())
    fmt::print("\nNot finished: {}.\n", printable(failure));
  else if (session.finished().empty())
    fmt::print("\nStopped by the user.\n");
  else
    fmt::print("\nFinished: {}.\n", session.finished());
  if (session.records().empty()) return;
  const StepRecord& last = session.records().back();
  if (last.surface_left && session.known_object() && !session.recording())
    fmt::print("Surface expected to be left: {}; truly left of what the candidates can see: {}.\n",
               percent_text(*last.surface_left), percent_text(1.0 - last.coverage_visible));
  if (session.known_object() && session.recording())
    fmt::print(
        "* within 3 voxels of the true surface, of which {:.1f} % is covered at d_reg = {}, {:.1f} % at the paper's "
        "0.5 mm.\n",
        100.0 * last.coverage, length_text(session.configuration().evaluation.d_reg), 100.0 * last.coverage_paper);
  else if (session.known_object())
    fmt::print(
        "* within 3 voxels of the surface. Coverage: of the surface that some candidate can see, at d_reg = {}; of all "
        "the\n"
        "  surface {:.1f} %; at the paper's 0.5 mm {:.1f} %.\n",
        length_text(session.configuration().evaluation.d_reg), 100.0 * last.coverage, 100.0 * last.coverage_paper);
  if (session.setup().recorded) print_orders(session);
  if (last.coverage_any_pose)
    fmt::print("  Of the surface that any pose could see {:.1f} %.\n", 100.0 * *last.coverage_any_pose);
}

void print_files(const Session& session, const std::filesystem::path& out, bool pictures, const std::string& surfaces) {
  const char* const driver = session.configuration().driver.name.empty() ? "" : " --driver …";  // no file starts one
  fmt::print("\n{}/\n", printable(out.string()));
  if (pictures) fmt::print("  step_01.png …   a picture of each step: views and scores, the map, the curves\n");
  fmt::print(
      "  map.ot, map.bt  the occupancy map (OctoMap: full, binary)\n"
      "{}  cloud.ply       the cleaned point cloud\n{}"
      "  steps.csv, scores.csv, views.csv, timings.csv, metrics.json   the numbers\n{}"
      "  journal, scans/ what was captured, and the choices: the scan can be gone on from, or shown:\n"
      "                  nextview scan --resume {}{}; nextview window {}\n"
      "  config.toml     the configuration; this repeats the scan:\n"
      "                  nextview scan --config {}{} --out {}\n",
      session.refinement() ? "  posterior.ot    the Gibbs map; refinement.csv: what each refinement did\n" : "",
      surfaces,
      session.recording() ? "  orders.csv      coverage by views: this order, the recorded one, random ones\n" : "",
      shell_text(out), driver, shell_text(out), shell_text(out / "config.toml"), driver, shell_text(free_folder(out)));
}

}  // namespace nextview
