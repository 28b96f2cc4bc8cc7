#pragma once
#include <memory>
#include <optional>
#include <stop_token>

#include "core/gain/map_rays.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/planner/policy.hpp"
#include "core/session/configuration.hpp"
#include "core/session/known_object.hpp"
#include "core/session/map_refinement.hpp"
#include "core/session/step_record.hpp"

namespace nextview {

/// A scan of one object: Algorithm 2, step by step. Not safe to use from two threads at once.
class Session {
 public:
  /// Loads the object and prepares the truth.
  /// @throws std::invalid_argument, std::runtime_error for settings and files; OutOfMemory; Stopped
  explicit Session(Configuration configuration, const Progress& progress = {}, std::stop_token stop = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes the next view and ranks the candidates for the one after. Returns false, and changes nothing, if a stop is
  /// requested before all of that is done; nothing is changed either where it throws.
  /// @throws OutOfMemory @pre finished().empty()
  bool step(const Progress& progress = {}, std::stop_token stop = {});
  /// Makes a candidate the next view instead of the proposal. @throws std::invalid_argument if it is not available.
  void override_next_view(std::size_t candidate);
  /// Makes a view of the operator's own the next one. Its record has view -1, overridden, and the gain that explain()
  /// expects of it now (0 if it has none). @throws std::invalid_argument before the first step, if the pose is not
  /// finite and rigid (is_rigid), or if the robot cannot reach it.
  void override_next_view(const Pose& T_world_camera);

  /// Changes when the scan is done, and keeps all else; a finished scan may go on by it.
  /// @throws std::invalid_argument if it is not valid.
  void set_termination(const TerminationConfig& config);

  /// Why the scan is done; empty while it is not.
  const std::string& finished() const { return finished_; }

  const Configuration& configuration() const { return configuration_; }
  const std::filesystem::path& object_file() const { return object_file_; }
  std::shared_ptr<const TriangleMesh> mesh() const { return {object_, &object_->mesh}; }
  const MeshTopology& object_topology() const { return object_->topology; }  ///< as its file has it
  const DepthCamera& camera() const { return camera_; }
  const OccupancyMap& map() const { return map_; }
  const MapRefinement* refinement() const { return refinement_.get(); }  ///< null unless the gain needs it
  /// The map that views are planned on: the Gibbs map if there is one.
  std::span<const Voxel> planning_voxels() const { return refinement_ ? refinement_->voxels() : map_.voxels(); }
  const std::vector<Pose>& candidates() const { return candidates_; }
  const std::vector<StepRecord>& records() const { return records_; }
  const std::vector<std::shared_ptr<const Scan>>& scans() const { return scans_; }     ///< one a step, returns cleaned
  const KnownObject* known_object() const { return known_object_.get(); }              ///< null without evaluation
  const std::vector<std::uint8_t>& visited_voxels() const { return visited_voxels_; }  ///< by noise-free rays

  /// Where the next view is taken from. Before the first step this is the start view.
  Pose next_view() const;
  /// The candidate that this is; none if it is the start view, or a view of the operator's own.
  std::optional<std::size_t> next_candidate() const { return next_; }
  /// Whether it is a view of the operator's own.
  bool next_view_is_own() const { return own_view_.has_value(); }
  const Policy& policy() const { return *policy_; }
  /// Why a candidate has its score now. Nothing if no rays explain the policy's values.
  std::optional<ScoreExplanation> explain(std::size_t candidate) const;
  /// What any other view would score now, taken apart. @pre is_rigid(T_world_camera)
  std::optional<ScoreExplanation> explain(const Pose& T_world_camera) const;

 private:
  struct Measurement {
    std::shared_ptr<const Scan> scan;  ///< returns cleaned
    DepthImage ideal_image;            ///< without noise; only with evaluation
  };
  /// What a step that does not come to its end goes back to.
  struct Before {
    Pose T_world_camera;
    MapChanges map;
    std::unique_ptr<MapRefinement> refinement;
    std::unique_ptr<ReferenceMap> reference_map;
    std::vector<bool> visited;
    std::vector<std::uint8_t> visited_voxels;
    KnownObject::Seen seen;
  };
  Before remember() const;
  void go_back(const Before& before);

  StepRecord begin_step() const;
  void take(StepRecord& record, Before& before, std::shared_ptr<const Scan>& scan, const Progress& progress,
            const std::stop_token& stop);
  Measurement measure(const Pose& T_world_camera, StepRecord& record, const Progress& progress,
                      const std::stop_token& stop) const;
  void update_map(const Measurement& measurement, StepRecord& record, MapChanges& undo, const std::stop_token& stop);
  void refine_map(const Measurement& measurement, StepRecord& record, const Progress& progress,
                  const std::stop_token& stop);
  void evaluate(const Measurement& measurement, StepRecord& record, const std::stop_token& stop);
  void rank(StepRecord& record, const std::stop_token& stop) const;
  void require_first_step() const;
  /// What the candidates are valued on; `rays` through one of the maps.
  PlanningState planning_state(const RayCaster& rays) const;
  const RayCaster& caster() const;

  Configuration configuration_;
  std::filesystem::path object_file_;
  std::shared_ptr<const PlacedMesh> object_;
  RayScene scene_;
  DepthCamera camera_;
  std::vector<Pose> candidates_;
  Pose start_view_;

  OccupancyMap map_;
  std::unique_ptr<MapRefinement> refinement_;
  MapRays map_rays_, planning_rays_;
  std::unique_ptr<ReferenceMap> reference_map_;  ///< reference semantics only
  RayBundle bundle_;
  std::unique_ptr<const Policy> policy_;
  std::unique_ptr<Robot> robot_;
  std::unique_ptr<KnownObject> known_object_;

  std::vector<bool> visited_;
  std::optional<std::size_t> next_;
  std::optional<Pose> own_view_;
  double own_gain_ = 0.0;  ///< expected of own_view_
  bool overridden_ = false;
  std::string finished_;
  std::vector<StepRecord> records_;
  std::vector<Pose> taken_;
  std::vector<std::shared_ptr<const Scan>> scans_;
  std::vector<std::uint8_t> visited_voxels_;
};

}  // namespace nextview
