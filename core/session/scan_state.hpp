#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/config/configuration.hpp"
#include "core/evaluation/entropy.hpp"
#include "core/evaluation/known_object.hpp"
#include "core/evaluation/recorded_surface.hpp"
#include "core/planner/planner.hpp"
#include "core/registration/scan_registration.hpp"
#include "core/robot/robot.hpp"
#include "core/session/step_record.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// What a scan is made with, and what stays as it is while it goes on.
struct ScanSetup {
  Configuration configuration;
  SourceDescription source;
  VoxelGrid region;       ///< of interest
  RayBundle bundle;       ///< that scores a view
  RayBundle fine_bundle;  ///< that scores the best ones again; of no rays: none does
  View start;
  std::shared_ptr<const OccupancyMap> start_map = {};  ///< that it begins with; null: nothing is known
  std::shared_ptr<const CandidateGenerator> candidates;
  std::shared_ptr<const Planner> planner;
  std::shared_ptr<const KnownObject> truth;              ///< null without evaluation
  std::shared_ptr<const CandidateSight> sight = {};      ///< of the candidates, if they are not those of `truth`
  std::shared_ptr<const RecordedSurface> recorded = {};  ///< null if the source is no recording
  std::vector<std::uint8_t> any_pose = {};  ///< KnownObject::seen_from_any_pose; empty unless it is asked for
  MapEntropy start_entropy = {};            ///< of the map before the first view

  /// How near a point must come to what it covers [m].
  double d_reg() const { return recorded ? recorded->d_reg() : configuration.evaluation.d_reg; }
};

/// The view that is taken next.
struct NextView {
  View view;
  std::optional<std::size_t> candidate = {};  ///< none: the start view, or a custom view
  bool is_custom = false;                     ///< it is the operator's own
  bool overridden = false;                    ///< the operator chose it instead of the proposal
  double gain = 0.0, utility = 0.0;           ///< that are expected of it
  std::string gain_unit = {};                 ///< the planner's that expects it
};

/// How far a scan has come: all that evolves, as a value. A copy costs a few pointers and shares what it has in common
/// with this; it can be kept, restored, forked, and handed to another thread.
struct ScanState {
  Knowledge known;
  std::shared_ptr<const EvaluationState> evaluation;  ///< null without evaluation
  std::vector<std::shared_ptr<const Scan>> scans;     ///< one per step, hits cleaned
  std::vector<std::shared_ptr<const StepRecord>> records;
  std::vector<View> candidates;            ///< that are ranked
  NextView next;                           ///< of no meaning once finished
  std::string finished;                    ///< why the scan is done; empty while it is not
  Pose T_world_camera = Pose::Identity();  ///< where the robot is, as it knows it
  bool has_maps = true;                    ///< false after drop_maps
};

/// A view that was taken and is not absorbed yet: the operator may look at it, and refuse it.
struct Acquired {
  View wanted;
  Pose reached = Pose::Identity();   ///< as the robot knows it
  Capture capture;                   ///< its pose is the one that counts: corrected, if it was
  Pose believed = Pose::Identity();  ///< the capture's pose as it came
  MotionCost motion;                 ///< of getting there
  double sense_seconds = 0.0, clean_seconds = 0.0;
  std::shared_ptr<const CapturedScan> cleaned = {};   ///< of a capture that was registered; null: it is to be cleaned
  std::optional<ScanRegistration> registration = {};  ///< with the scans before it; none: not asked for
  /// What the robot then said of the candidates; empty: it is to be asked.
  std::vector<Reach> reach = {};
};

}  // namespace nextview
