#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/evaluation/known_object.hpp"
#include "core/gain/view_score.hpp"
#include "core/sensor/recorded_scans.hpp"

namespace nextview {

/// The candidate views of a recorded scene, scored after all its scans.
struct SceneScores {
  std::vector<std::string> gains;  ///< those of single voxels first, in the order of `names`
  std::vector<ViewScore> views;    ///< in the scene's order; raw values
};

/// `names`: of gains, or 'combined' (pre-release weights). Parameters that the scene leaves out have the reference
/// code's defaults; `warn` hears of those that have no meaning here.
/// @throws std::invalid_argument for a gain or parameter that makes no sense, or a scene without views; OutOfMemory;
///         Stopped
SceneScores score_scene(const RecordedScene& scene, Semantics semantics, std::span<const std::string> names,
                        const std::function<void(const std::string&)>& warn = {}, const Progress& progress = {},
                        std::stop_token stop = {});

}  // namespace nextview
