#pragma once
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/gain/gain.hpp"

namespace nextview {

/// What one candidate view was found to be worth.
struct ViewScore {
  std::vector<double> gains;  ///< in the order of the gains asked for
  std::size_t rays = 0;
  std::size_t voxels = 0;     ///< visited, over all rays; without those that could change nothing any more
  double milliseconds = 0.0;  ///< how long this view took; the only field that differs from run to run
};

struct ScoreOptions {
  Semantics semantics = Semantics::published;
  double occlusion_reach = 60.0;  ///< d_max of proximity count [voxels]
};

/// Scores each view by each gain, the views in parallel; the same result on any number of threads.
/// A requested stop leaves the rest of the scores empty.
std::vector<ViewScore> score_views(const RayCaster& caster, std::span<const Pose> views, const RayBundle& bundle,
                                   std::span<const Gain* const> gains, const ScoreOptions& options = {},
                                   std::stop_token stop = {});

/// A score taken apart: per ray the voxels, their probability, visibility and contribution. The contributions of all
/// rays sum to `value`.
struct ScoreExplanation {
  struct Voxel {
    std::array<std::int16_t, 3> lattice{};
    bool measured = false;
    double probability = 0.5;
    double visibility = 1.0;
    double contribution = 0.0;
  };
  struct RayPart {
    Vector3 direction;  ///< unit, world
    std::vector<Voxel> voxels;
    double contribution = 0.0;
  };
  double value = 0.0;
  std::vector<RayPart> rays;
};

ScoreExplanation explain_score(const RayCaster& caster, const Pose& view, const RayBundle& bundle, const Gain& gain,
                               const ScoreOptions& options = {});

}  // namespace nextview
