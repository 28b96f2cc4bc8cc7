#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/gain/new_surface.hpp"
#include "core/planner/planner.hpp"

namespace nextview {

/// Where views that fit the object are looked for.
struct AdaptiveCandidatesConfig {
  int kept = 16;            ///< views made at each step, beside the fixed ones
  double distance = 0.9;    ///< from which the object is looked at: from two fifths of it to a tenth more [m]
  double min_range = 0.2;   ///< of the camera: no view is nearer to what is known of the object [m]
  double ray_length = 1.5;  ///< [m]
  NewSurfaceModel model = NewSurfaceModel::fitted();
  std::uint64_t seed = 1;
};

/// Some fixed views, and those that promise most new surface among many drawn around what is known of the object. No
/// two of them look at nearly the same from nearly the same place. The same on any number of threads.
class AdaptiveCandidates : public CandidateGenerator {
 public:
  /// `rays` are few: they rank the views that are drawn; the planner looks closer at those that are left.
  AdaptiveCandidates(std::vector<View> fixed, RayBundle rays, const AdaptiveCandidatesConfig& config)
      : fixed_(std::move(fixed)), rays_(std::move(rays)), config_(config) {}
  std::vector<View> candidates(const Knowledge& known) const override;

 private:
  struct Drawing;
  static std::vector<Pose> all_around(const Drawing& drawing);
  static std::vector<Pose> towards_frontiers(const Drawing& drawing);
  static std::vector<Pose> about(const Drawing& drawing, std::span<const Pose> poses);

  std::vector<View> fixed_;
  RayBundle rays_;
  AdaptiveCandidatesConfig config_;
};

}  // namespace nextview
