// The Gibbs map beside every baseline, near the surface, each truth by its own read-out. Prints a row a map and object
// as CSV, then the means over the objects; the manual's table comes from it (gibbs).
//   build/release/posterior_comparison                                all held-out objects
//   build/release/posterior_comparison --object bunny --views 4       some of it
//   build/release/posterior_comparison --fit read-outs                fits these to made-up parts; then the next
//   build/release/posterior_comparison --fit terms                    ... the conventional map's
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>

#include "core/evaluation/baseline_maps.hpp"
#include "core/evaluation/openings.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/progress/stopwatch.hpp"
#include "tests/benchmarks/calibrated_terms.hpp"
#include "tests/benchmarks/evidence_posterior.hpp"
#include "tests/benchmarks/posterior_fit.hpp"
#include "tests/benchmarks/read_out_of_rays_alone.hpp"

namespace nextview {
namespace {

struct Options {
  std::vector<std::string> objects = held_out_objects();
  std::vector<int> views = {4, 20};
  std::vector<std::string> sensors = {"small", "default"};
  std::vector<EvidencePose> poses = {EvidencePose::as_placed, EvidencePose::turned};
  std::string fit;
  bool before = true;
  bool decided = false;
};

/// Scores of the maps of one sensor and number of views: by map, one an object.
using Scores = std::map<std::string, std::vector<MapScores>>;

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

/// All maps of one case.
class Comparison {
 public:
  Comparison(const EvidenceCase& c, Scores& scores) : case_(c), scores_(scores) {}

  void run(bool before) {
    gibbs("Gibbs", 0.0, ReadOut::fitted);
    const BaselineMaps baselines(case_.grid, case_.scans);
    for (const BaselineMapInfo& info : baseline_maps) add(std::string(info.name), baselines.make(info.map));
    for (const CalibratedTerms& terms : calibrated_terms)
      if (std::string_view(terms.sensor) == case_.sensor.name) add(terms);
    if (before) gibbs("Gibbs before", 1.0, ReadOut::levels);
  }

 private:
  void add(const std::string& map, const std::vector<Voxel>& voxels) {
    row(map, score_map(voxels, voxels, case_.truth), "");
  }

  void add(const CalibratedTerms& terms) {
    InverseSensorModel model;
    model.hit = terms.hit, model.miss = terms.miss;
    model.clamp_min = terms.clamp_min, model.clamp_max = terms.clamp_max;
    OccupancyMap map(case_.grid, model);
    for (const Scan& scan : case_.scans) map.insert(scan);
    add(fmt::format("calibrated to {}", terms.fitted_to), map.voxels().dense());
  }

  void gibbs(const char* name, double independence, ReadOut read_out_as) {
    PosteriorSamplerConfig config = sampler_of(case_);
    config.model.independence = independence;
    config.read_out = read_out_as;
    if (read_out_as == ReadOut::levels) config.ray_spacing = 0.6;  // as it was then
    double seconds = 0.0;
    GibbsPosterior posterior = [&] {
      const Stopwatch watch(seconds);
      return sample_posterior(case_.grid, measurements_of(case_.scans), config, octomap_of(case_));
    }();
    const SamplerDiagnostics& d = posterior.diagnostics;
    if (read_out_as == ReadOut::fitted) find_openings(posterior);
    row(name, *score_posterior(posterior, {}, case_.truth),
        fmt::format("{:.1f} s {} sweeps R-hat {:.3f}{}", seconds, d.sweeps, d.r_hat,
                    d.stationary ? "" : " NOT stationary"));
    if (read_out_as != ReadOut::fitted) return;
    read_out(posterior, rays_of(case_), read_out_of_rays_alone());
    row("read-out of rays alone", *score_posterior(posterior, {}, case_.truth), "");
  }

  /// Of the Gibbs map, by the probability from which on a voxel is called occupied.
  void find_openings(const GibbsPosterior& posterior) {
    if (case_.truth.openings.empty()) return;
    const std::vector<Voxel> read_out = posterior.centre_voxels({});
    std::vector<Voxel> classes = read_out;
    for (double threshold = 0.02; threshold < 1.0; threshold += 0.02) {
      for (std::size_t v = 0; v < classes.size(); ++v)
        classes[v].probability = read_out[v].probability < threshold ? 0.25f : 0.75f;
      OpeningScore& score = openings_.emplace_back();
      for (const Opening& opening : case_.truth.openings)
        score += score_opening(opening, classes, case_.truth.voxels, TruthConvention::centre, case_.truth.visited);
    }
  }

  /// The Gibbs map's at the threshold that leaks no more than another map does.
  OpeningScore openings_at(const std::optional<double>& leaks) const {
    const auto too_leaky = std::find_if(openings_.begin(), openings_.end(), [&](const OpeningScore& score) {
      return score.leaks().value_or(0.0) > leaks.value_or(0.0);
    });
    return too_leaky == openings_.begin() ? OpeningScore{} : *std::prev(too_leaky);
  }

  void row(const std::string& map, const MapScores& s, const std::string& remark) {
    const OpeningScore gibbs = openings_at(s.openings.leaks());
    fmt::print("{},{},\"{}\",{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{},{},{},{}\n", case_.object,
               name_of(case_.pose), case_.sensor.name, case_.views, map, s.touch_band.log_loss,
               s.touch_band.calibration_error, s.centre_band.log_loss, s.centre_band.calibration_error,
               s.touch_visited.log_loss, cell(s.surface_recall), cell(s.openings.row_openness()),
               cell(s.openings.recall()), cell(s.openings.leaks()), cell(gibbs.row_openness()), cell(gibbs.recall()),
               remark);
    std::fflush(stdout);
    scores_[map].push_back(s);
  }

  const EvidenceCase& case_;
  Scores& scores_;
  std::vector<OpeningScore> openings_;
};

/// Means over the objects, and on how many of them the Gibbs map has less log loss than the map of the row.
void print_means(const std::string& of, const Scores& scores) {
  const std::vector<MapScores>& gibbs = scores.at("Gibbs");
  fmt::print(
      "\n# {}: mean over {} objects: touch log loss, ECE, centre log loss, ECE, surface recall; Gibbs is better "
      "on (touch, centre)\n",
      of, gibbs.size());
  for (const auto& [map, of_objects] : scores) {
    double sums[5] = {};
    int touch = 0, centre = 0;
    for (std::size_t i = 0; i < of_objects.size(); ++i) {
      const MapScores& s = of_objects[i];
      const double values[] = {s.touch_band.log_loss, s.touch_band.calibration_error, s.centre_band.log_loss,
                               s.centre_band.calibration_error, s.surface_recall.value_or(0.0)};
      for (int k = 0; k < 5; ++k) sums[k] += values[k] / double(of_objects.size());
      touch += gibbs[i].touch_band.log_loss < s.touch_band.log_loss;
      centre += gibbs[i].centre_band.log_loss < s.centre_band.log_loss;
    }
    fmt::print("# {:<26} {:.4f}  {:.4f}   {:.4f}  {:.4f}   {:.3f}   {:>2} {:>2}\n", map, sums[0], sums[1], sums[2],
               sums[3], sums[4], touch, centre);
  }
}

void compare(const Options& options) {
  fmt::print(
      "object,pose,sensor,views,map,log_loss_touch_band,ece_touch_band,log_loss_centre_band,ece_centre_band,"
      "log_loss_touch_visited,surface_recall,rows_open,opening_recall,leaks,gibbs_rows_open_at_these_leaks,"
      "gibbs_opening_recall_at_these_leaks,remark\n");
  std::map<std::string, Scores> all;
  for (const EvidenceSensor& sensor : fitting_sensors) {
    if (std::find(options.sensors.begin(), options.sensors.end(), sensor.key) == options.sensors.end()) continue;
    for (const int views : options.views)
      for (const EvidencePose pose : options.poses)
        for (const std::string& object : options.objects) {
          EvidenceCase c = evidence_case(object, pose, sensor, views);
          if (options.decided)
            fmt::print("# {}: {:.1f} % of the voxels near the surface are left out\n", object,
                       1e2 * leave_out_undecided_centres(c));
          Comparison(c, all[fmt::format("{}, {} views, {}", sensor.name, views, name_of(pose))]).run(options.before);
        }
  }
  for (const auto& [of, scores] : all) print_means(of, scores);
}

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::Options options;
  CLI::App program("Compares the Gibbs map with every baseline near the surface; CSV on standard output.");
  program.add_option("--object", options.objects, "objects to compare on");
  program.add_option("--views", options.views, "numbers of views")->capture_default_str();
  program.add_option("--sensor", options.sensors, "small, between, default, large, short")->capture_default_str();
  program.add_option("--pose", options.poses, "of the objects")
      ->transform(CLI::CheckedTransformer(std::map<std::string, nextview::EvidencePose>{
          {"placed", nextview::EvidencePose::as_placed}, {"turned", nextview::EvidencePose::turned}}));
  program.add_flag("--before,!--no-before", options.before, "the Gibbs map of 0.4.0 too, which takes half of the time");
  program.add_flag("--decided-centres", options.decided, "leave out voxels whose centre a face goes right through");
  program.add_option("--fit", options.fit, "fit the read-outs, or the conventional map's terms, instead")
      ->check(CLI::IsMember({"read-outs", "terms"}));
  CLI11_PARSE(program, argc, argv);
  try {
    if (options.fit == "terms")
      nextview::fit_terms(options.views);
    else if (options.fit == "read-outs")
      nextview::fit_read_outs(options.views);
    else
      nextview::compare(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "posterior_comparison: {}\n", error.what());
    return 2;
  }
}
