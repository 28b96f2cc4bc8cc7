#pragma once
#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The usual distance from a point to the nearest other one: the median over a thousand of them [m]. 0 of fewer than
/// two.
double point_spacing(const PointCloud& points);

}  // namespace nextview
