#pragma once
#include <bitset>
#include <span>
#include <stop_token>
#include <vector>

#include "core/gain/new_surface.hpp"

namespace nextview {

/// The surface that is not covered yet, as it may be in one world.
struct DrawnWorld {
  static constexpr std::size_t samples = 256;
  using Samples = std::bitset<samples>;  ///< of that surface, evenly over its area

  std::vector<Samples> seen;  ///< by each view
  double area = 0.0;          ///< that a sample stands for [cm^2]
};

/// How worlds are drawn.
struct WorldDraws {
  int count = 32;
  double ray_length = 1.5;  ///< how far views see [m]
  std::uint64_t seed = 1;
  std::uint32_t step = 0;  ///< worlds of different steps are different
};

/// Worlds that agree with a map, and what views would see there. Where voxels are unmeasured a solid is drawn: it
/// begins as deep below what is free, as rays count depth, as an exponential distribution says whose quantile varies
/// smoothly from place to place. So straight rays into it end as the field has it, and views see the same surface.
/// Surface in measured voxels counts by its chance. The same on any number of threads.
/// @throws Stopped
std::vector<DrawnWorld> draw_worlds(const SurfaceEvidence& evidence, const NewSurfaceField& field,
                                    std::span<const Pose> views, const RayBundle& bundle, const WorldDraws& draws,
                                    std::stop_token stop = {});

}  // namespace nextview
