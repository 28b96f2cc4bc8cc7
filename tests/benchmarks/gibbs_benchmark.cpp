// The Gibbs sampler at the paper's scale (20 views of 160 x 120, 1 cm) against Algorithm 1 as it reads, which casts the
// rays of a voxel again for each of its states: one run, so that the ratios mean something.
//   build/release/gibbs_benchmark
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <memory>

#include "core/config/configuration.hpp"
#include "core/gibbs/chain.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/map/traversal.hpp"
#include "core/mesh/mesh_file.hpp"
#include "tests/benchmarks/simulated_views.hpp"

namespace nextview {
namespace {

constexpr std::size_t sampled_voxels = 20'000;

struct Setup {
  VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  RangeMeasurements measurements;
  std::vector<float> conventional;

  Setup() {
    DepthCameraConfig camera;
    camera.width = 160;
    camera.height = 120;
    OccupancyMap map(grid, InverseSensorModel{});
    for (const Scan& scan : simulate_views(load_mesh(default_object()), camera, 20).scans) {
      measurements.add(scan);
      map.insert(scan);
    }
    conventional = probabilities(map.voxels());
  }
};

Setup& setup() {
  static Setup the_setup;
  return the_setup;
}

PosteriorSamplerConfig config_of(ForwardModel model) {
  PosteriorSamplerConfig config;
  config.model.kind = model;
  config.swaps = 0;  // single-voxel updates alone, as in Algorithm 1
  return config;
}

/// Sweeps per second of one chain on one thread, past its burn-in.
void sweep(benchmark::State& state, ForwardModel model) {
  const PosteriorSamplerConfig config = config_of(model);
  const RayLists lists(setup().grid, setup().measurements, config.model);
  const Sites sites = find_sites(lists, config, setup().conventional);
  const auto chain = make_chain(lists, config, sites, 0);
  chain->start(start_levels(lists, config, setup().conventional, 0));
  for (int i = 0; i < 5; ++i) chain->sweep(nullptr);
  for (auto _ : state) chain->sweep(nullptr);
  state.counters["voxels"] = static_cast<double>(sites.count());
  state.counters["incidences"] = static_cast<double>(lists.incidence_count());
  state.counters["bytes per ray"] = static_cast<double>(lists.bytes()) / static_cast<double>(lists.rays());
  state.counters["bytes per voxel"] = static_cast<double>(lists.bytes()) / static_cast<double>(sites.count());
  state.counters["MB"] = static_cast<double>(lists.bytes() + chain->bytes()) / 1e6;
}
void Sweep_Beam(benchmark::State& state) { sweep(state, ForwardModel::beam); }
void Sweep_Attenuation(benchmark::State& state) { sweep(state, ForwardModel::attenuation); }

void Lists(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(RayLists(setup().grid, setup().measurements, config_of(ForwardModel::beam).model));
}

/// log p(z | m) of a ray by the beam model, cast anew through the map.
double recast(const RangeMeasurement& ray, const ForwardSensorModel& model, const std::vector<std::uint8_t>& map) {
  const Setup& s = setup();
  const Vector3& origin = s.measurements.origins[ray.origin];
  const double z = s.measurements.range(ray), floor = model.random_weight / s.measurements.max_range;
  double value = ray.beyond_range ? 1.0 - model.random_weight : floor;
  walk_ray_segments(s.grid, origin, s.measurements.direction(ray), ray.beyond_range ? z : z + 4.0 * model.sigma,
                    [&](int x, int y, int cell_z, double enter, double exit) {
                      const std::uint32_t voxel = s.grid.index({x, y, cell_z});
                      if (map[voxel] == 0) return true;
                      value = ray.beyond_range
                                  ? model.max_weight
                                  : model.hit_weight() * hit_density(s.grid, model, origin, {voxel, enter, exit}, z) +
                                        floor;
                      return false;
                    });
  return std::log(value);
}

/// Algorithm 1's step for a sample of the observed voxels: the rays of each are cast again for both of its states. That
/// the rays of a voxel are known is already more than Algorithm 1 says.
void Recast_SampleOfVoxels(benchmark::State& state) {
  const Setup& s = setup();
  const PosteriorSamplerConfig config = config_of(ForwardModel::beam);
  const RayLists lists(s.grid, s.measurements, config.model);
  const Sites sites = find_sites(lists, config, s.conventional);
  std::vector<std::uint8_t> map = start_levels(lists, config, s.conventional, 0);
  std::vector<std::uint32_t> observed = sites.near_voxels;
  observed.insert(observed.end(), sites.front_voxels.begin(), sites.front_voxels.end());
  std::map<std::uint32_t, std::vector<std::uint32_t>> rays_of;
  for (std::size_t k = 0; k < sampled_voxels; ++k) rays_of[observed[k * observed.size() / sampled_voxels]];
  for (std::uint32_t n = 0; n < s.measurements.rays.size(); ++n)
    for (const VoxelSegment& segment : ray_segments(s.grid, s.measurements, s.measurements.rays[n], config.model))
      if (const auto found = rays_of.find(segment.voxel); found != rays_of.end()) found->second.push_back(n);

  for (auto _ : state)
    for (const auto& [voxel, rays] : rays_of) {
      const std::uint8_t level = map[voxel];
      double log_odds = 0.0;
      for (const std::uint8_t trial : {1, 0}) {
        map[voxel] = trial;
        for (const std::uint32_t n : rays)
          log_odds += (trial ? 1.0 : -1.0) * recast(s.measurements.rays[n], config.model, map);
      }
      benchmark::DoNotOptimize(log_odds);
      map[voxel] = level;
    }
  state.counters["voxels of a sweep over those timed"] =
      static_cast<double>(sites.count()) / static_cast<double>(rays_of.size());
}

BENCHMARK(Sweep_Beam)->Unit(benchmark::kMillisecond);
BENCHMARK(Sweep_Attenuation)->Unit(benchmark::kMillisecond);
BENCHMARK(Lists)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Recast_SampleOfVoxels)->Unit(benchmark::kMillisecond)->Iterations(1);

/// Prints as always, and the ratios at the end.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      double time = run.GetAdjustedRealTime();
      for (const auto& [name, counter] : run.counters)
        if (name.starts_with("voxels of a sweep")) time *= counter.value;
      time_[run.run_name.function_name] = time;
    }
  }
  void print_ratios() {
    if (time_.size() < 4) return;
    const double recast = time_["Recast_SampleOfVoxels"];
    fmt::print(
        "\nA sweep that casts rays again takes {:.0f} s. Of that, a sweep of `beam` takes 1/{:.0f} ({:.1f} ms), a "
        "sweep of `attenuation` 1/{:.0f} ({:.1f} ms); the lists take as long as {:.0f} sweeps of `beam`.\n",
        recast / 1e3, recast / time_["Sweep_Beam"], time_["Sweep_Beam"], recast / time_["Sweep_Attenuation"],
        time_["Sweep_Attenuation"], time_["Lists"] / time_["Sweep_Beam"]);
  }

 private:
  std::map<std::string, double> time_;  ///< [ms], of a whole sweep
};

}  // namespace
}  // namespace nextview

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  nextview::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratios();
}
