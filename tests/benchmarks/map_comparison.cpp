// The Gibbs map beside the conventional map and the other baselines, on objects with known surfaces. Prints a row a map
// as CSV; the manual's table comes from it (gibbs).
//   build/release/map_comparison                               all objects, takes about an hour
//   build/release/map_comparison --object bunny --views 4      some of it
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "core/evaluation/baseline_maps.hpp"
#include "core/evaluation/visited_voxels.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/map/ground_truth.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "core/offline/refinement.hpp"
#include "tests/benchmarks/simulated_views.hpp"

namespace nextview {
namespace {

struct Options {
  std::vector<std::string> objects = {"gearbox", "bunny", "slotted_plate", "slotted_housing"};
  std::vector<int> views = {4, 20};
  std::vector<double> turned = {0.0, 1.0};
  int width = 160;
  double noise = 0.005, outliers = 0.01;
  std::vector<std::string> only;
};

/// A Gibbs map to compare.
struct Variant {
  const char* name;
  void (*change)(PosteriorSamplerConfig&);
};
constexpr Variant variants[] = {
    {"attenuation", [](PosteriorSamplerConfig&) {}},
    {"attenuation 0.3/2",
     [](PosteriorSamplerConfig& c) {
       c.model.attenuations = {0.3, 2.0};
     }},
    {"beam",
     [](PosteriorSamplerConfig& c) {
       c.model.kind = ForwardModel::beam;
       c.prior = 0.05;
       c.swaps = 2;
     }},
    {"cone",
     [](PosteriorSamplerConfig& c) {
       c.model.kind = ForwardModel::cone;
       c.prior = 0.05;
       c.sweeps = 90;
     }},
    {"paper exact",
     [](PosteriorSamplerConfig& c) {
       c.model.kind = ForwardModel::paper;
       c.model.voxel_range = VoxelRange::centre;
       c.prior = 0.05;
       c.sweeps = 90;
     }},
    {"paper algorithm1",
     [](PosteriorSamplerConfig& c) {
       c.model.kind = ForwardModel::paper;
       c.model.voxel_range = VoxelRange::centre;
       c.prior = 0.5;
       c.sampler = Sampler::algorithm1;
       c.sweeps = 20;
       c.until_stationary = false;
     }},
    {"beam algorithm1",
     [](PosteriorSamplerConfig& c) {
       c.model.kind = ForwardModel::beam;
       c.prior = 0.5;
       c.sampler = Sampler::algorithm1;
       c.sweeps = 20;
       c.until_stationary = false;
     }},
};

/// Turned about all three axes, and moved off the grid by a share of a voxel.
Eigen::Affine3d turned(double amount) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (amount != 0.0)
    T = Eigen::Translation3d(0.0031, -0.0047, 0.0023) * Eigen::AngleAxisd(0.35 * amount, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(0.2 * amount, Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(0.35 * amount, Eigen::Vector3d::UnitX());
  return T;
}

RefinementTruth truth_of(const std::string& object, const Eigen::Affine3d& T, const VoxelGrid& grid) {
  PlacedMesh placed_mesh = load_placed_mesh(resolve_object(object), {0.5});
  for (Eigen::Vector3f& v : placed_mesh.mesh.vertices) v = (T * v.cast<double>()).cast<float>();
  RefinementTruth truth{std::make_shared<TriangleMesh>(placed_mesh.mesh),
                        ground_truth(placed_mesh.mesh, grid),
                        std::vector<std::uint8_t>(grid.voxel_count()),
                        {}};
  const auto file = resolve_object(object).replace_extension(".json");
  if (!std::filesystem::exists(file)) return truth;
  for (Opening opening : read_openings(file)) {
    opening = placed(opening, placed_mesh.placement);
    opening.centre = T * opening.centre;
    opening.axis = T.linear() * opening.axis;
    opening.along = T.linear() * opening.along;
    truth.openings.push_back(opening);
  }
  return truth;
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

/// One object, from one number of views.
class Comparison {
 public:
  Comparison(const Options& options, const std::string& object, double turn, int views)
      : options_(options), label_(fmt::format("{},{},{}", object, turn != 0.0 ? "turned" : "aligned", views)) {
    const RefinementTruth truth = truth_of(object, turned(turn), grid_);
    camera_.width = options.width;
    camera_.height = options.width * 3 / 4;
    camera_.range_noise = options.noise;
    camera_.outliers = options.outliers;
    views_ = simulate_views(*truth.mesh, camera_, views);
    truth_ = truth;
    BitMask visited(grid_.voxel_count());
    for (const Scan& ideal : views_.ideal) mark_visited(grid_, ideal, visited);
    truth_->visited = visited.bytes();
  }

  void run() {
    const BaselineMaps baselines(grid_, views_.scans);
    std::vector<float> conventional;
    for (const BaselineMapInfo& info : baseline_maps) {
      const auto voxels = baselines.make(info.map);
      if (info.map == BaselineMap::octomap) conventional = probabilities(voxels);
      row(std::string(info.name), voxels, 0.0, "");
    }
    RangeMeasurements measurements{camera_.max_range, {}, {}};
    for (const Scan& scan : views_.scans) measurements.add(scan);
    for (const Variant& variant : variants) {
      const auto& only = options_.only;
      if (!only.empty() && std::find(only.begin(), only.end(), variant.name) == only.end()) continue;
      PosteriorSamplerConfig config;
      config.model.sigma = camera_.range_noise;
      config.model.angular_sigma = 0.5 * ray_pitch(camera_);
      config.read_out = ReadOut::levels;  // what models are worth; posterior_comparison has what is read out of them
      config.ray_spacing = 0.6;           // as all tables of the levels were made
      variant.change(config);
      const auto start = std::chrono::steady_clock::now();
      const GibbsPosterior posterior = sample_posterior(grid_, measurements, config, conventional);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const SamplerDiagnostics& d = posterior.diagnostics;
      row(variant.name, posterior.voxels(InverseSensorModel{}), seconds,
          fmt::format("{} sweeps R-hat {:.3f} trend {:.1f} differ {}", d.sweeps, d.r_hat, d.trend,
                      d.disagreeing_voxels));
      if (std::string_view(variant.name) == "attenuation 0.3/2") {
        GibbsPosterior upper = posterior;
        upper.occupied = posterior.upper;
        row("attenuation 0.3/2 (upper level)", upper.voxels(InverseSensorModel{}), 0.0, "");
      }
    }
  }

 private:
  void row(const std::string& map, std::span<const Voxel> voxels, double seconds, const std::string& remark) const {
    const MapScores s = *score_map({grid_.size, voxels}, truth_);
    fmt::print("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.0f},{:.0f},{},{},{},{},{:.1f},{}\n", label_, map,
               s.touch_band.log_loss, s.touch_band.brier, s.centre_band.log_loss, s.centre_band.brier,
               s.touch_visited.log_loss, s.touch_visited.divergence, s.centre_visited.divergence,
               cell(s.openings.row_openness()), cell(s.openings.recall()), cell(s.openings.leaks()),
               cell(s.surface_recall), seconds, remark);
    std::fflush(stdout);
  }

  const Options& options_;
  std::string label_;
  VoxelGrid grid_ = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  DepthCameraConfig camera_;
  SimulatedViews views_;
  std::optional<RefinementTruth> truth_;
};

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  nextview::Options options;
  CLI::App program("Compares the Gibbs map with the conventional map and other baselines; CSV on standard output.");
  program.add_option("--object", options.objects, "objects")->capture_default_str();
  program.add_option("--views", options.views, "numbers of views")->capture_default_str();
  program.add_option("--turned", options.turned, "0: aligned with the grid; 1: not")->capture_default_str();
  program.add_option("--width", options.width, "image width; three quarters of it high [px]")->capture_default_str();
  program.add_option("--noise", options.noise, "of ranges [m]")->capture_default_str();
  program.add_option("--outliers", options.outliers, "share of pixels")->capture_default_str();
  program.add_option("--only", options.only, "these of the Gibbs maps instead of all");
  CLI11_PARSE(program, argc, argv);
  try {
    fmt::print(
        "object,pose,views,map,log_loss_touch_band,brier_touch_band,log_loss_centre_band,brier_centre_band,"
        "log_loss_touch_visited,d_kl_touch_visited,d_kl_centre_visited,rows_open,opening_recall,leaks,"
        "surface_recall,seconds,remark\n");
    for (const std::string& object : options.objects)
      for (const double turn : options.turned)
        for (const int views : options.views) nextview::Comparison(options, object, turn, views).run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "map_comparison: {}\n", error.what());
    return 2;
  }
}
