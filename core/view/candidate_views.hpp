#pragma once
#include <string>
#include <vector>

#include "core/setting/setting.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// How candidate views are laid out (the view space). All face the target.
enum class ViewLayout {
  hemisphere,  ///< latitude rings of equal spacing on the upper half of a sphere
  sphere,      ///< latitude rings of equal spacing on the whole sphere (default)
  rings,       ///< `rings` rings of equal size between 60 degrees above and below the horizon
  fibonacci,   ///< spherical Fibonacci lattice on the whole sphere
  file,        ///< poses read from `file`
  adaptive     ///< those of `sphere`, and at each step some that fit what is known of the object
};

struct CandidateViewsConfig {
  ViewLayout layout = ViewLayout::sphere;
  int count = 48;       ///< number of views; ignored by `file`
  double radius = 0.9;  ///< distance from the target [m]; ignored by `file`
  int rings = 3;        ///< number of rings; `rings` only
  std::string file;     ///< views file; `file` only
  int adaptive = 16;    ///< number of views made at each step; `adaptive` only

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(CandidateViewsConfig& config);

/// Those that stay the same all the time.
std::vector<Pose> candidate_views(const CandidateViewsConfig& config, const Vector3& target);

}  // namespace nextview
