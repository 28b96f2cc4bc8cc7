#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/gibbs/ray_lists.hpp"
#include "core/gibbs/sampler_diagnostics.hpp"
#include "core/map/occupancy.hpp"

namespace nextview {

enum class Sampler {
  exact,      ///< draws from the full conditional
  algorithm1  ///< as printed: the conditional is replaced by 0.7 or 0.4, whichever side of 0.5 it is on
};
/// How a voxel's posterior becomes the probabilities that maps, scores and pictures show.
enum class ReadOut {
  fitted,  ///< as made-up parts taught: what the levels around it say too (core/gibbs/read_out.hpp)
  levels   ///< P(level > 0)
};
/// `occupied`: only voxels that the start map calls occupied; the others stay free, and keep its probability.
enum class UpdatedVoxels { occupied_and_free, occupied };
enum class StartMap { octree, free, occupied, random };

/// What the Gibbs sampler does (Algorithm 1 and beyond).
struct PosteriorSamplerConfig {
  ForwardSensorModel model;
  double prior = 0.1;  ///< of a voxel being at any level but free; the levels share it evenly
  Sampler sampler = Sampler::exact;
  UpdatedVoxels updated = UpdatedVoxels::occupied_and_free;
  StartMap start = StartMap::octree;
  int swaps = -1;                ///< passes of neighbour swaps per sweep; -1: none with attenuation, else 1
  int plaquettes = 0;            ///< passes of 2 x 2 plaquettes per sweep
  int chains = 2;                ///< independent of each other
  int sweeps = 400;              ///< at most, a chain
  int burn_in = 2;               ///< sweeps before the first attempt at a mean
  bool until_stationary = true;  ///< stop once stationary; otherwise all sweeps, burn-in left out, are the mean
  /// Fitted to levels that are drawn as by default: with another model, attenuations or prior, the sampler
  /// Algorithm 1, or if not all voxels are updated, it is `levels`.
  ReadOut read_out = ReadOut::fitted;
  double ray_spacing = 0.7;  ///< rays this near each other at the region's centre are merged [voxel edges]; 0: none
  std::uint64_t seed = 1;
  /// Keeps GibbsPosterior::traces. For people who look into a run: no setting of files, and no result depends on it.
  bool keep_traces = false;
  std::size_t max_trace_bytes = std::size_t{200} << 20;  ///< of the traces; beyond it the oldest sweeps are dropped

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
/// Without the model's.
std::vector<Setting> settings(PosteriorSamplerConfig& config);

/// The levels that the chains drew for the voxels near a return, sweep by sweep of the mean.
struct LevelTraces {
  std::vector<std::uint32_t> voxels;  ///< ascending
  /// [chain][sweep][place in `voxels`]; as many sweeps of each chain.
  std::vector<std::deque<std::vector<std::uint8_t>>> levels;
  std::size_t dropped = 0;  ///< sweeps at the mean's beginning that are left out, for want of memory
};

/// The posterior of every voxel of a grid, and how it came about. What the levels mean follows from the model: of
/// attenuations such as {0.3, 2}, `occupied` says that a surface touches the voxel and `upper` that its centre is
/// solid.
struct GibbsPosterior {
  VoxelGrid grid;
  std::vector<float> occupied;                    ///< P(level > 0 | z). 0.5 where not informed
  std::vector<float> upper;                       ///< P(uppermost level | z). 0.5 where not informed
  std::vector<std::uint8_t> informed;             ///< 1: on posterior average at least half a measured ray reaches it
  std::vector<std::vector<std::uint8_t>> states;  ///< the last map of each chain, to start from again
  SamplerDiagnostics diagnostics;
  LevelTraces traces;  ///< with PosteriorSamplerConfig::keep_traces
  /// By PosteriorSamplerConfig::read_out, 0.5 where not informed: that the surface touches the voxel, the map's p, and
  /// that its centre is inside the object. ReadOut::levels: both are `occupied`.
  std::vector<float> touch = {}, centre = {};

  /// The posterior as gains, pictures and scores see a map: measured means informed. p is `touch`.
  std::vector<Voxel> voxels(const InverseSensorModel& classes) const { return voxels_of(touch, classes); }
  /// The same, p being `centre`: what is open and what is solid.
  std::vector<Voxel> centre_voxels(const InverseSensorModel& classes) const { return voxels_of(centre, classes); }

 private:
  std::vector<Voxel> voxels_of(std::span<const float> p, const InverseSensorModel& classes) const;
};

/// Where a run goes on from: its chains start with the maps of an earlier one, and leave out half as many sweeps.
struct WarmStart {
  std::span<const std::vector<std::uint8_t>> states = {};  ///< GibbsPosterior::states
  /// If given, the posterior of the rays before `first_new_ray` of the lists. Voxels that only those pass, and no ray
  /// ends near, keep what it says of them, and their levels: they are free, and rays elsewhere change little about
  /// that.
  const GibbsPosterior* kept = nullptr;
  std::uint32_t first_new_ray = 0;
};

/// Is given every few sweeps how far a run has come, which never goes back, and how it goes: `so_far` has the traces up
/// to now, what is worked out from them as of the last mean that was tried. It is valid during the call. Called from
/// the thread that samples.
using SamplerProgress = std::function<void(double fraction, std::string_view what, const SamplerDiagnostics& so_far)>;

/// What SamplerProgress is told before the first sweep.
inline constexpr std::string_view listing_rays = "listing the rays of each voxel";

/// Draws from p(m | z), z being the rays of lists. `start_map`: probabilities that StartMap::octree starts from
/// (occupied where p >= 0.5), and that UpdatedVoxels::occupied updates; empty: all free. The same bytes on any number
/// of threads; a requested stop ends the sweeps early and the diagnostics say so. The sensor model is that of the
/// lists, PosteriorSamplerConfig::ray_spacing has no say.
/// @throws std::invalid_argument for a configuration out of bounds, or a start that is of another grid or model, or
/// keeps voxels though not all are updated.
GibbsPosterior sample_posterior(const RayLists& lists, const PosteriorSamplerConfig& config,
                                std::span<const float> start_map = {}, const WarmStart& warm = {},
                                const SamplerProgress& progress = {}, std::stop_token stop = {});

/// The same of measurements: merges them by PosteriorSamplerConfig::ray_spacing and lists them first.
/// @throws std::invalid_argument also for rays that would not fit into memory.
GibbsPosterior sample_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                const PosteriorSamplerConfig& config, std::span<const float> start_map = {},
                                const WarmStart& warm = {}, const SamplerProgress& progress = {},
                                std::stop_token stop = {});

}  // namespace nextview
