#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/view/pose.hpp"

namespace nextview {

/// A line of sight through a point of the window [m, world]; the direction of any length.
struct Sight {
  Vector3 origin, direction;
};

/// What a box is dragged by: the middles of its faces, two an axis with the upper one second, and its centre.
constexpr std::size_t box_handles = 7, centre_handle = 6;

Vector3 handle_place(const Eigen::AlignedBox3d& box, std::size_t handle);

/// How far along a line, from `point` towards the unit vector `along`, it comes nearest to a line of sight [m]; nothing
/// where one looks along it, so that a pixel would be a long way.
std::optional<double> along_line(const Vector3& point, const Vector3& along, const Sight& sight);

/// The box after one of its handles followed the pointer from a sight to another: a face goes along its axis, the
/// centre takes the box along in the plane across `forward`. What moves goes by whole voxels of this edge [m], and
/// faces stay 1 to 512 of them apart.
Eigen::AlignedBox3d dragged(const Eigen::AlignedBox3d& box, std::size_t handle, const Sight& from, const Sight& to,
                            const Vector3& forward, double voxel);

/// As the setting map.region has it: "x y z x y z" of two opposite corners [m].
std::string region_text(const Eigen::AlignedBox3d& box);

}  // namespace nextview
