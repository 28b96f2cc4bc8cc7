#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/map_quality.hpp"
#include "core/gibbs/sampler_diagnostics.hpp"
#include "core/planner/next_best_view.hpp"
#include "core/registration/scan_registration.hpp"
#include "core/robot/robot.hpp"

namespace nextview {

/// Seconds of each stage of a step.
struct StageSeconds {
  double sense = 0.0, clean = 0.0, insert = 0.0, refine = 0.0, evaluate = 0.0, score = 0.0;
};

/// What refining the map did (gain gibbs only).
struct RefinementRecord {
  SamplerDiagnostics diagnostics;
  std::size_t changed_class = 0;  ///< voxels whose class differs from the conventional map's
  /// Of each candidate: the same gain on the conventional map. Empty, as what follows of it, if another planner ranks
  /// them now that needs no Gibbs map.
  std::vector<double> conventional_gains;
  std::optional<std::size_t> conventional_best;  ///< the candidate that it would have chosen
  double rank_correlation = 0.0;                 ///< Spearman's, of both maps' gains over the available candidates
  MapQuality quality_near_surface;               ///< with evaluation; as StepRecord::quality_near_surface
};

/// One turn of Algorithm 2: where the camera went, what it saw, how good the map is now, and how the candidates rank
/// after it.
struct StepRecord {
  int step = 0;             ///< from 1
  int view = -1;            ///< index of the candidate that was taken; -1: a view that is none of them
  bool overridden = false;  ///< an operator chose it instead of the proposal
  Pose T_world_camera = Pose::Identity();
  MotionCost motion;  ///< of getting here
  double gain = 0.0;  ///< predicted for this view when it was chosen, in the gain's unit; 0 for the start view, and for
                      ///< a custom view where the gain is not one of single views
  std::string gain_unit;     ///< of the planner that chose it, or ranked it; it may have been another than now
  double utility = 0.0;      ///< 0 for a view that is no candidate: it is a share of all candidates
  double new_surface = 0.0;  ///< that it showed, by its points alone, whatever the truth is [cm^2]
  /// After this view: share of the surface that is expected to be left for the candidates; none: not predicted.
  std::optional<double> surface_left;
  double realised_gain = 0.0;  ///< entropy that the map lost by this view [nats] (Eq. 12)

  std::size_t hits = 0;        ///< pixels that met a surface
  std::size_t misses = 0;      ///< pixels beyond range
  std::size_t points = 0;      ///< hits left after cleaning
  std::size_t new_voxels = 0;  ///< voxels measured for the first time

  double entropy = 0.0;                     ///< of the maximum-likelihood map (Eq. 18) [bits]
  double total_entropy = 0.0;               ///< sum of H(p) [bits]
  std::optional<double> coverage_recorded;  ///< of a recording: share of what all its frames show, at d_reg
  // With evaluation:
  double coverage = 0.0;                    ///< of all the surface, at d_reg (Eq. 17)
  double coverage_visible = 0.0;            ///< of the surface that some candidate sees, at d_reg
  std::optional<double> coverage_any_pose;  ///< of the surface that any pose could see, at d_reg; none: not asked for
  double coverage_paper = 0.0;              ///< of all the surface, at the paper's 0.5 mm
  MapQuality quality;                       ///< over visited voxels, touch truth
  MapQuality quality_near_surface;          ///< over visited voxels of the band, touch truth

  std::optional<ScanRegistration> registration;  ///< with the scans before it; none: not asked for, or the first

  std::optional<RefinementRecord> refinement;  ///< total_entropy, realised_gain and gains are then the Gibbs map's

  std::vector<Candidate> candidates;  ///< as ranked after this view
  Ranking ranking;
  StageSeconds seconds;
};

}  // namespace nextview
