#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/gain/expected_view.hpp"
#include "core/gibbs/full_conditional.hpp"
#include "core/map/voxel_history.hpp"
#include "ui/workbench/selection.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// What a view measured, or is expected to see, and what it is worth.
struct ViewInspection {
  ViewSelection view;
  Pose T_world_camera = Pose::Identity();
  ExpectedView expected;        ///< of the map that views are planned on
  std::vector<float> measured;  ///< depth [m] in the cells of `expected`, negative: nothing; empty: not taken yet
  std::shared_ptr<const ScoreExplanation> explanation;  ///< null: see `no_explanation`
  std::string no_explanation;
  std::string why_empty;  ///< it would measure nothing; empty: it would, or it has been taken
};

/// Why a voxel is as it is.
struct VoxelInspection {
  std::uint32_t voxel = 0;
  std::vector<VoxelUpdate> history;            ///< one per view
  std::vector<std::vector<VoxelRay>> rays;     ///< one per view: those that touch it, some of them if there are many
  std::optional<FullConditional> conditional;  ///< given the rest of the sampler's last map; if there is a Gibbs map
  std::vector<std::vector<std::uint8_t>>
      trace;  ///< its level after each sweep of the mean, one per chain; may be empty
};

/// What is known of what the user has picked.
struct Inspection {
  std::uint64_t number = 0;                        ///< counts inspections, from 1
  std::shared_ptr<const SessionSnapshot> session;  ///< that it is of; null: nothing yet
  Selection selection;
  std::optional<ViewInspection> view;
  std::optional<VoxelInspection> voxel;
};

/// Where the view that is looked at is taken from; nothing if there is none of that number.
std::optional<Pose> selected_view_pose(const SessionSnapshot& session, const Selection& selection);

}  // namespace nextview
