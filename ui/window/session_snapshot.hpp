#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/session/configuration.hpp"
#include "core/session/step_record.hpp"

namespace nextview {

/// A session as the window sees it between two steps. Never changes once it is published. What a step does not change
/// is shared with the snapshot before.
struct SessionSnapshot {
  std::uint64_t session = 0;  ///< counts the sessions that were loaded; 0: there is none yet
  std::uint64_t map = 0;      ///< counts the maps: different whenever voxels, cloud or records are
  std::string message;        ///< why the last command failed; empty if it did not

  Configuration configuration;
  std::string object_name;                           ///< for people
  std::shared_ptr<const TriangleMesh> mesh;          ///< null without a session; so are the next two
  std::shared_ptr<const std::vector<Voxel>> voxels;  ///< one a voxel of the grid
  std::shared_ptr<const PointCloud> cloud;           ///< all views so far
  VoxelGrid grid;
  PinholeCamera camera;
  std::vector<Pose> candidates;  ///< T_world_camera
  std::vector<StepRecord> records;
  std::string gain_unit;

  Pose next_view = Pose::Identity();                    ///< T_world_camera
  std::optional<std::size_t> next_candidate;            ///< none: the start view, or nothing is left
  std::shared_ptr<const ScoreExplanation> explanation;  ///< of the next view's score; null if its gain has no rays
  std::string finished;                                 ///< why the scan is done; empty while it is not

  bool loaded() const { return session > 0; }
  /// The candidate that the planner would take; the next view, unless that was overridden.
  std::optional<std::size_t> proposal() const { return records.empty() ? std::nullopt : records.back().ranking.best; }
  bool available(std::size_t candidate) const {
    return !records.empty() && candidate < candidates.size() && records.back().candidates[candidate].available;
  }
};

/// What the session worker is doing right now.
struct WorkerProgress {
  bool busy = false;
  bool playing = false;
  double fraction = 0.0;  ///< of the job, 0 to 1
  std::string what;
  std::size_t waiting = 0;  ///< commands behind it

  bool operator==(const WorkerProgress&) const = default;
};

}  // namespace nextview
