#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/gibbs/sampler_diagnostics.hpp"
#include "core/map/voxel_bricks.hpp"

namespace nextview {

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
  /// The same in bricks.
  VoxelBricks bricks(const InverseSensorModel& classes) const;
  /// The same, p being `centre`: what is open and what is solid.
  std::vector<Voxel> centre_voxels(const InverseSensorModel& classes) const { return voxels_of(centre, classes); }

 private:
  Voxel voxel_of(std::size_t voxel, float p, const InverseSensorModel& classes) const;
  std::vector<Voxel> voxels_of(std::span<const float> p, const InverseSensorModel& classes) const;
};

}  // namespace nextview
