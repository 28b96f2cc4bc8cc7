#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/setting/setting.hpp"
#include "core/view/length_unit.hpp"
#include "core/view/pose.hpp"
#include "core/view/up_axis.hpp"

namespace nextview {

/// How candidate views are laid out (the view space). All face the target.
enum class ViewLayout {
  hemisphere,  ///< latitude rings of equal spacing on the upper half of a sphere
  sphere,      ///< latitude rings of equal spacing on the whole sphere (default)
  rings,       ///< `rings` rings of equal size between 60 degrees above and below the horizon
  fibonacci,   ///< spherical Fibonacci lattice on the whole sphere
  file,        ///< poses read from `file`: a views file, or projection matrices
  adaptive     ///< those of `sphere`, and at each step some that fit what is known of the object
};

/// How the coordinates that projection matrices stand in become the world's: as those of the object's file do.
struct ProjectionPlacement {
  Vector3 centre = Vector3::Zero();  ///< becomes the origin [unit]
  double scale = 0.0;                ///< [m per unit]; 0: there is no object to say
  UpAxis up = UpAxis::z;             ///< of the object's file
};

struct CandidateViewsConfig {
  ViewLayout layout = ViewLayout::sphere;
  int count = 48;                           ///< number of views; ignored by `file`
  double radius = 0.9;                      ///< distance from the target [m]; ignored by `file`
  int rings = 3;                            ///< number of rings; `rings` only
  std::string file;                         ///< views file, or file or folder of projection matrices; `file` only
  LengthUnit unit = LengthUnit::automatic;  ///< of projection matrices; automatic: that of the object's file
  int adaptive = 16;                        ///< number of views made at each step; `adaptive` only
  ProjectionPlacement projections;          ///< no setting: who loads the object says it

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(CandidateViewsConfig& config);

/// Those that stay the same all the time. `notice`, if given, hears what was passed over in a folder of projection
/// matrices.
/// @throws std::invalid_argument naming the setting; std::runtime_error naming the file
std::vector<Pose> candidate_views(const CandidateViewsConfig& config, const Vector3& target,
                                  const std::function<void(const std::string&)>& notice = {});

}  // namespace nextview
