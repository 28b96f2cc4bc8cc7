#pragma once
#include <memory>
#include <optional>
#include <stop_token>

#include "core/gain/map_rays.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/session/candidate_gains.hpp"
#include "core/session/configuration.hpp"
#include "core/session/known_object.hpp"
#include "core/session/map_refinement.hpp"
#include "core/session/step_record.hpp"

namespace nextview {

/// A scan of one object: Algorithm 2, step by step. Not safe to use from two threads at once.
class Session {
 public:
  /// Loads the object and prepares the truth. A requested stop throws std::runtime_error.
  /// @throws std::invalid_argument, std::runtime_error for settings and files.
  explicit Session(Configuration configuration, const Progress& progress = {}, std::stop_token stop = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes the next view and ranks the candidates for the one after. Returns false, and changes nothing, if a stop is
  /// requested before the measurement enters the map. @pre finished().empty()
  bool step(const Progress& progress = {}, std::stop_token stop = {});
  /// Makes a candidate the next view instead of the proposal. @throws std::invalid_argument if it is not available.
  void override_next_view(std::size_t candidate);

  /// Why the scan is done; empty while it is not.
  const std::string& finished() const { return finished_; }

  const Configuration& configuration() const { return configuration_; }
  const std::filesystem::path& object_file() const { return object_file_; }
  std::shared_ptr<const TriangleMesh> mesh() const { return mesh_; }
  const DepthCamera& camera() const { return camera_; }
  const OccupancyMap& map() const { return map_; }
  const MapRefinement* refinement() const { return refinement_.get(); }  ///< null unless the gain needs it
  /// The map that views are planned on: the Gibbs map if there is one.
  std::span<const Voxel> planning_voxels() const { return refinement_ ? refinement_->voxels() : map_.voxels(); }
  const std::vector<Pose>& candidates() const { return candidates_; }
  const std::vector<StepRecord>& records() const { return records_; }
  const std::vector<PointCloud>& clouds() const { return clouds_; }                    ///< one a step, cleaned
  const KnownObject* known_object() const { return known_object_.get(); }              ///< null without evaluation
  const std::vector<std::uint8_t>& visited_voxels() const { return visited_voxels_; }  ///< by noise-free rays

  /// The next view: a candidate; none before the first step, when it is the start view.
  std::optional<std::size_t> next_candidate() const { return next_; }
  Pose next_view() const { return next_ ? candidates_[*next_] : start_view_; }
  /// Why a candidate has its score now. Nothing for the combination and the baselines, which have no rays of their own.
  std::optional<ScoreExplanation> explain(std::size_t candidate) const;

 private:
  struct Measurement {
    Scan scan;               ///< cleaned
    DepthImage ideal_image;  ///< without noise; only with evaluation
  };
  Measurement measure(const Pose& T_world_camera, StepRecord& record) const;
  void update_map(const Measurement& measurement, StepRecord& record);
  void refine_map(const Measurement& measurement, StepRecord& record, const Progress& progress);
  void evaluate(const Measurement& measurement, StepRecord& record);
  void rank_candidates(StepRecord& record, std::stop_token stop);
  void compare_rankings(StepRecord& record, std::span<const std::size_t> available) const;
  std::string termination() const;
  const RayCaster& caster() const;

  Configuration configuration_;
  std::filesystem::path object_file_;
  std::shared_ptr<const TriangleMesh> mesh_;
  RayScene scene_;
  DepthCamera camera_;
  std::vector<Pose> candidates_;
  Pose start_view_;

  OccupancyMap map_;
  std::unique_ptr<MapRefinement> refinement_;
  MapRays map_rays_, planning_rays_;
  std::unique_ptr<ReferenceMap> reference_map_;  ///< reference semantics only
  RayBundle bundle_;
  std::unique_ptr<Robot> robot_;
  std::unique_ptr<KnownObject> known_object_;

  std::vector<bool> visited_;
  std::optional<std::size_t> next_;
  bool overridden_ = false;
  std::string finished_;
  std::vector<StepRecord> records_;
  std::vector<Pose> taken_;
  std::vector<PointCloud> clouds_;
  std::vector<std::uint8_t> visited_voxels_;
};

}  // namespace nextview
