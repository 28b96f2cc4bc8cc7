#pragma once
#include <array>
#include <vector>

#include "core/gain/surface_evidence.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

inline constexpr double square_centimetres_of_a_square_metre = 1e4;

/// How likely a ray that reaches a voxel meets surface there that no view has covered: learned from simulated scans
/// (`nextview calibrate --fit new-surface`). The coefficients stand in the order of SurfaceEvidence's features.
struct NewSurfaceModel {
  /// ln of the rate at which rays end in unmeasured voxels [1 / object size].
  std::array<double, std::tuple_size_v<SurfaceEvidence::Unmeasured>> unmeasured{};
  /// Log-odds of new surface in a free voxel, where a ray may end, and in an occupied one, where it does.
  std::array<double, std::tuple_size_v<SurfaceEvidence::Measured>> free{}, occupied{};
  double mean_slant = 1.7;  ///< area of the surface that rays meet, over the area across them
  SurfaceSlant slant = {};  ///< of new surface
  /// Share of the surface that is left, over that of a strip along the border where it may go on (open_border), as wide
  /// as the radius at which the scanned surface is told apart: the median of made-up parts of which 0.2 to 1 % are
  /// left. It is no part of the fit.
  double left_at_border = 1.6;
  /// Of surface whose area across the rays is so many m^2 [cm^2].
  double square_centimetres(double across) const { return square_centimetres_of_a_square_metre * mean_slant * across; }

  bool operator==(const NewSurfaceModel&) const = default;
  /// Fitted to simulated scans of parts that were made up for it.
  static NewSurfaceModel fitted();

  /// The probability that a ray which gets to a voxel meets new surface there. Negative, that with the other sign: it
  /// goes no farther.
  float chance(const SurfaceEvidence& evidence, const Eigen::Vector3i& cell) const;
  /// The same of each of the unmeasured voxels in a block (SurfaceEvidence::unmeasured).
  float chance_in_block(const SurfaceEvidence& evidence, const Eigen::Vector3i& block) const;
};
std::vector<Setting> settings(NewSurfaceModel& model);

}  // namespace nextview
