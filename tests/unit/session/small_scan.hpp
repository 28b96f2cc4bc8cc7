#pragma once
#include <algorithm>

#include "core/session/session.hpp"

namespace nextview {

/// A scan that takes a fraction of a second: the box, coarse voxels, a small image.
inline Configuration small_scan() {
  Configuration c;
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply";
  c.sensor.width = 80;
  c.sensor.height = 60;
  c.map.resolution = 0.04;
  c.views.count = 10;
  c.planner.ray_columns = 12;
  c.planner.ray_rows = 9;
  c.termination.views = 4;
  c.termination.surface_left = 0.0;
  c.evaluation.surface_samples = 2000;
  c.evaluation.d_reg = 0.02;
  return c;
}

inline void finish(Session& session) {
  while (session.finished().empty()) session.step();
}

/// Whether two scans found the same, to the byte; seconds aside.
inline bool same_candidates(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Candidate& x, const Candidate& y) {
    return x.available == y.available && x.gain == y.gain && x.cost == y.cost && x.utility == y.utility;
  });
}

inline bool same_quality(const MapQuality& a, const MapQuality& b) {
  return a.voxels == b.voxels && a.log_loss == b.log_loss && a.brier == b.brier && a.divergence == b.divergence &&
         a.calibration_error == b.calibration_error;
}

inline bool same_record(const StepRecord& a, const StepRecord& b) {
  return a.step == b.step && a.view == b.view && a.overridden == b.overridden &&
         a.T_world_camera.matrix() == b.T_world_camera.matrix() && a.motion.distance == b.motion.distance &&
         a.motion.rotation == b.motion.rotation && a.motion.seconds == b.motion.seconds && a.gain == b.gain &&
         a.utility == b.utility && a.realised_gain == b.realised_gain && a.hits == b.hits && a.misses == b.misses &&
         a.points == b.points && a.new_voxels == b.new_voxels && a.entropy == b.entropy &&
         a.total_entropy == b.total_entropy && a.coverage == b.coverage && a.coverage_visible == b.coverage_visible &&
         a.coverage_paper == b.coverage_paper && same_quality(a.quality, b.quality) &&
         same_quality(a.quality_near_surface, b.quality_near_surface) && same_candidates(a.candidates, b.candidates) &&
         a.ranking.best == b.ranking.best && a.ranking.degenerate == b.ranking.degenerate;
}

/// Of the same measurements, whether or not the planner wanted occlusions marked.
inline bool same_map_but_for_occlusions(const OccupancyMap& a, const OccupancyMap& b) {
  return std::ranges::equal(a.voxels(), b.voxels(), {}, &Voxel::log_odds, &Voxel::log_odds) &&
         std::ranges::equal(a.voxels(), b.voxels(), {}, &Voxel::measured, &Voxel::measured);
}

inline bool same_map(const OccupancyMap& a, const OccupancyMap& b) {
  return std::equal(a.voxels().begin(), a.voxels().end(), b.voxels().begin(), b.voxels().end(),
                    [](const Voxel& x, const Voxel& y) {
                      return x.log_odds == y.log_odds && x.probability == y.probability && x.measured == y.measured &&
                             x.occlusion_distance == y.occlusion_distance;
                    });
}

inline bool same_scans(const Session& a, const Session& b) {
  return std::equal(
      a.scans().begin(), a.scans().end(), b.scans().begin(), b.scans().end(), [](const auto& x, const auto& y) {
        return x->origin == y->origin && x->hits == y->hits && x->misses == y->misses && x->max_range == y->max_range;
      });
}

inline bool same_evaluation(const EvaluationState* a, const EvaluationState* b) {
  if (!a || !b) return a == b;
  return a->visited_voxels == b->visited_voxels && a->seen == b->seen &&
         std::ranges::equal(a->coverage.observed(), b->coverage.observed()) &&
         std::ranges::equal(a->coverage_paper.observed(), b->coverage_paper.observed());
}

inline bool same_scan(const Session& a, const Session& b) {
  return std::equal(a.records().begin(), a.records().end(), b.records().begin(), b.records().end(), same_record) &&
         same_map(a.map(), b.map()) && same_scans(a, b) && same_evaluation(a.evaluation(), b.evaluation()) &&
         a.next_candidate() == b.next_candidate() && a.finished() == b.finished();
}

}  // namespace nextview
