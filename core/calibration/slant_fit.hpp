#pragma once
#include <span>
#include <vector>

#include "core/gain/new_surface.hpp"

namespace nextview {

/// A map at one step of a scan, and what views would have shown from there on.
struct ShownByViews {
  SurfaceEvidence evidence;
  RayBundle bundle;
  double ray_length = 0.0;  ///< [m]
  std::vector<Pose> views;
  std::vector<double> areas;  ///< of new surface, by view [cm^2]
  double surface = 0.0;       ///< of the object, all of it [cm^2]
};

/// The slants with which a model expects of whole views what they showed: errors are shares of the object's surface,
/// and their squares are least. Steeper than single rays have it: where the model expects surface that is not there,
/// its normal is likely to point to who looks. The same on any number of threads.
/// @throws std::invalid_argument if nothing is expected of any view.
SurfaceSlant fit_slant(const NewSurfaceModel& model, std::span<const ShownByViews> shown);

}  // namespace nextview
