#pragma once
#include <Eigen/Geometry>
#include <string>

namespace nextview {

/// "200 x 100 x 50 mm, from (…) to (…)" of a box [m], in the unit that suits.
std::string extents_text(const Eigen::AlignedBox3d& box);

}  // namespace nextview
