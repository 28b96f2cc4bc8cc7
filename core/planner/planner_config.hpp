#pragma once
#include <string>
#include <vector>

#include "core/gain/new_surface_model.hpp"
#include "core/gain/ray.hpp"
#include "core/planner/next_best_view.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

/// How a gain is weighed against the way to it.
enum class UtilityKind { weighted_shares, gain_per_second };

struct PlannerConfig {
  std::string gain = "new-surface";  ///< the name of a policy (policy_names)
  Semantics semantics = Semantics::published;
  UtilityKind utility = UtilityKind::weighted_shares;
  UtilityWeights weights = {1.0, 0.3};  ///< of Eq. 13; with 1 and 1 the way decides, as gains differ by less
  std::string combined_weights;         ///< `gain=weight,gain=weight`; empty: the pre-release weights
  int ray_columns = 38;                 ///< rays that score a view
  int ray_rows = 25;
  int ray_refinement = 4;   ///< times as many each way score the best two views again, but no more than pixels; 1: none
  double ray_window = 1.0;  ///< share of the image's width and height that they go through, about its middle
  double ray_length = 1.5;  ///< [m]
  int simulations = 0;      ///< plans of several views that are tried out before one is taken; 0: one view at a time
  double start_azimuth = 30.0;    ///< of the start view, seen from the target [deg]
  double start_elevation = 20.0;  ///< [deg]
  std::string start_view;         ///< as parse_view takes it; empty: from azimuth and elevation
  NewSurfaceModel new_surface = NewSurfaceModel::fitted();

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(PlannerConfig& config);

}  // namespace nextview
