#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/config/configuration.hpp"
#include "core/gain/view_score.hpp"
#include "core/gibbs/gibbs_posterior.hpp"
#include "core/map/ground_truth.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/session/camera_bookmarks.hpp"
#include "core/session/scan_state.hpp"
#include "ui/workbench/laid_out_voxels.hpp"
#include "ui/workbench/timeline.hpp"

namespace nextview {

/// Some points of all views so far, to be looked at; the whole clouds are in SessionSnapshot::scans.
struct SeenCloud {
  std::vector<Eigen::Vector3f> points;   ///< [m, world]
  std::vector<std::uint16_t> views;      ///< of each point, from 0
  std::vector<Eigen::Vector3f> normals;  ///< of each point, out of the surface (viewed_normals)
  std::vector<float> distances;          ///< of each point to the true surface [m]; empty if that is not known
};

/// What refining changed, over the voxels.
struct RefinementChange {
  std::size_t changed_class = 0;                     ///< voxels
  double entropy_before = 0.0, entropy_after = 0.0;  ///< sums over all voxels [nats]
  std::array<std::size_t, 20> before{}, after{};     ///< informed and measured voxels by probability, in equal bins
};

RefinementChange refinement_change(std::span<const Voxel> conventional, std::span<const Voxel> refined);

/// The Gibbs map of the first views of a scan. What is large is shared with the refinement that made it.
struct GibbsMap {
  std::size_t views = 0;  ///< that it is made of; fewer than were taken: it is out of date
  std::shared_ptr<const GibbsPosterior> posterior;
  LaidOutVoxels voxels;                                   ///< the posterior as the scene and the gains see it
  std::shared_ptr<const RangeMeasurements> measurements;  ///< what it was sampled from
  PosteriorSamplerConfig config;
  RefinementChange change;  ///< against the conventional map of the same views
};

/// Points of the object's surface.
struct SurfacePoints {
  std::vector<Eigen::Vector3f> points;   ///< [m, world]
  std::vector<Eigen::Vector3f> outward;  ///< of each, the unit normal; empty if the mesh does not tell its outside
};

/// The object with its surface marked as measured or missed.
struct MissedPicture {
  std::shared_ptr<const TriangleMesh> mesh;  ///< the object in small triangles
  std::vector<std::uint8_t> observed;        ///< one per vertex
};

/// An earlier scan of this window, for its curves.
struct Run {
  std::string name;                 ///< "gearbox, occlusion-aware"
  std::vector<StepRecord> records;  ///< without candidates
  std::string object;               ///< that was scanned
};

struct SessionSnapshot;

/// The end of another branch, beside the session.
struct Comparison {
  std::string branch;
  std::shared_ptr<const SessionSnapshot> snapshot;
};

/// A session as the window sees it between two steps. Never changes once it is published. What a step does not change
/// is shared with the snapshot before.
struct SessionSnapshot {
  std::uint64_t session = 0;  ///< counts the sessions that were loaded; 0: there is none yet
  std::uint64_t map = 0;      ///< counts the maps: different whenever voxels, cloud or records are
  std::string message;        ///< why the last request failed; empty if it did not
  std::size_t failures = 0;   ///< counts the requests that failed

  Configuration configuration;
  std::shared_ptr<const ScanSetup> setup;               ///< null without a session
  ScanState state;                                      ///< shares its maps with the session
  std::string object_name;                              ///< for people
  bool live = false;                                    ///< scans with a live scanner
  bool scanner_lost = false;                            ///< which must be reached again
  std::vector<std::string> notes;                       ///< Session::notes
  std::shared_ptr<const TriangleMesh> mesh;             ///< null where none is known, with the surface points
  Eigen::AlignedBox3d object_box;                       ///< of the mesh; without one of the grid [m, world]
  std::string guessed_unit;                             ///< of the mesh's file: "mm"; empty if nothing was guessed
  std::shared_ptr<const SurfacePoints> surface_points;  ///< some of the mesh's, evenly spread
  LaidOutVoxels voxels;                                 ///< the conventional map; null without a session
  std::shared_ptr<const SeenCloud> cloud;
  std::shared_ptr<const GibbsMap> gibbs;     ///< null if there is none
  std::shared_ptr<const GroundTruth> truth;  ///< null without evaluation; so is the next
  std::shared_ptr<const MissedPicture> missed;
  std::shared_ptr<const CoverageByOrder> orders;   ///< of a recording, once a view was taken; else null
  std::vector<std::shared_ptr<const Scan>> scans;  ///< one per step
  VoxelGrid grid;
  PinholeCamera camera;
  std::vector<Pose> candidates;  ///< T_world_camera
  std::vector<StepRecord> records;
  std::string gain_unit;
  bool planned_on_posterior = false;                     ///< the policy looks at the Gibbs map
  std::shared_ptr<const std::vector<Run>> earlier_runs;  ///< oldest first; may be null

  Pose next_view = Pose::Identity();                    ///< T_world_camera
  std::optional<std::size_t> next_candidate;            ///< none: the start view, a custom view, or nothing is left
  bool custom_next_view = false;                        ///< the next view is a custom one
  std::shared_ptr<const ScoreExplanation> explanation;  ///< of the next view's score; null if its gain has no rays
  std::string finished;                                 ///< why the scan is done; empty while it is not
  bool can_undo = false, can_redo = false;
  std::uint64_t change = 0;                    ///< the number of the one that undo takes back; no two have the same
  std::shared_ptr<const Timeline> timeline;    ///< null without a session
  std::shared_ptr<const Comparison> compared;  ///< null if the session is shown alone
  bool kept = false;                           ///< what was taken is in a folder
  bool keeping_fails = false;                  ///< it was to be, and is in memory alone
  std::size_t gibbs_lost = 0;                  ///< views of this scan's Gibbs map that is in no folder; 0: none is
  std::size_t gibbs_lost_aside = 0;            ///< Gibbs maps of scans that were set aside, which are in none, either
  std::shared_ptr<const std::vector<CameraBookmark>> cameras;  ///< to look at the scene from; may be null

  bool loaded() const { return session > 0; }
  /// Views on all branches, each once, wherever the scan stands: what it takes to start over.
  std::size_t views_on_branches() const;
  /// Goes through recorded data, whose frames are the candidates.
  bool is_recording() const { return setup && setup->recorded; }
  /// Compares the scan with the true surface, where one is known.
  bool is_evaluated() const { return configuration.evaluation.enabled && (!setup || setup->truth); }
  /// The candidate that the planner would take; the next view, unless that was overridden.
  std::optional<std::size_t> proposal() const { return records.empty() ? std::nullopt : records.back().ranking.best; }
  bool available(std::size_t candidate) const {
    return !records.empty() && candidate < candidates.size() && records.back().candidates[candidate].available;
  }
  /// The map that views are planned on.
  std::span<const Voxel> planning_voxels() const { return planned_on_posterior && gibbs ? *gibbs->voxels : *voxels; }
};

/// A scan that does not fit those before it, while an operator decides on it.
struct DoubtfulScan {
  std::vector<Eigen::Vector3f> reached;    ///< its points from where the robot says that it stands [m, world]
  std::vector<Eigen::Vector3f> corrected;  ///< where registration puts them; empty if that is not reliable
};

/// What the session worker is doing right now.
struct WorkerProgress {
  bool busy = false;
  bool playing = false;
  bool refining = false;
  bool paused = false;      ///< refining is paused
  bool cancelling = false;  ///< what runs was told to stop, and has not yet
  bool opening = false;     ///< another session is on its way: nothing can be done to this one
  double fraction = 0.0;    ///< of the job, 0 to 1
  std::string what;
  std::string question;                               ///< that the job waits for an answer to; empty: it does not
  std::uint64_t question_number = 0;                  ///< of the last question; no two have the same
  std::vector<std::string> answers;                   ///< that there are, the last one the cautious one
  std::vector<std::string> effects;                   ///< what each of them does; empty: their names say it
  bool costs = false;                                 ///< what the first of them does
  std::shared_ptr<const DoubtfulScan> doubtful;       ///< that the question is about; null if it is about another thing
  std::size_t waiting = 0;                            ///< requests behind it
  std::optional<double> seconds_left;                 ///< of the job, as it has gone so far; whole seconds
  double pause_between_views = 0.0;                   ///< while playing [s]
  std::shared_ptr<const SamplerDiagnostics> sampler;  ///< of the refinement that runs, up to now

  /// That stands out, and Enter gives: the first one, or the cautious one where that costs something. @pre there are
  /// any
  std::size_t usual_answer() const { return costs ? answers.size() - 1 : 0; }
  bool operator==(const WorkerProgress&) const = default;
};

}  // namespace nextview
