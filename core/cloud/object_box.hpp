#pragma once
#include <Eigen/Geometry>
#include <span>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The box of an object of which these points were seen. Nobody has seen the back: the box goes on away from the
/// cameras by what it lacks of being half as deep again as it is wide, but not through the planes that it stands on or
/// before.
/// @param towards_cameras the mean of the unit directions from the points to where they were seen from
/// @param planes_normals of these planes, unit length, to the object's side
Eigen::AlignedBox3d object_box(const PointCloud& points, const Vector3& towards_cameras,
                               std::span<const Vector3> planes_normals);

}  // namespace nextview
