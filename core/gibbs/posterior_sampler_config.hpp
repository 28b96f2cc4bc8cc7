#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"

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

}  // namespace nextview
