#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/gain/new_surface.hpp"

namespace nextview {

/// A map at one step of a scan, and what views would have shown from there on.
struct ShownByViews {
  SurfaceEvidence evidence;
  RayBundle bundle;
  double ray_length = 0.0;  ///< [m]
  double surface = 0.0;     ///< of the object, all of it [cm^2]
  std::vector<Pose> views;
  std::vector<double> areas;  ///< of new surface, by view [cm^2]
};

/// The slants with which a model expects of whole views what they showed: errors are shares of the object's surface,
/// and their squares are least. Steeper than single rays have it: where the model expects surface that is not there,
/// its normal is likely to point to who looks. Both are the larger by `views_taken_show`. The same on any number of
/// threads.
class SlantFit {
 public:
  /// Of what is expected of them where all views alike show what is expected: the best are better than that. By least
  /// squares 1.22, 1.20 and 1.26 in scans of 24 made-up parts at 320 x 240, 640 x 480 and 160 x 120 pixels; no part of
  /// the fit, whose views are not taken.
  static constexpr double views_taken_show = 1.22;

  explicit SlantFit(const NewSurfaceModel& model) : model_(model) {}
  void add(const ShownByViews& shown);
  /// @throws std::invalid_argument if nothing was expected of any view.
  SurfaceSlant fit() const;

 private:
  NewSurfaceModel model_;
  /// The normal equations: what is expected is linear in both slants.
  Eigen::Matrix2d expected_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d met_ = Eigen::Vector2d::Zero();
};

}  // namespace nextview
