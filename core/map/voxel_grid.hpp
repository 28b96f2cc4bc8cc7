#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "core/view/pose.hpp"

namespace nextview {

/// A box of voxels on OctoMap's lattice: voxel faces lie at whole multiples of the resolution, voxel n spans [n, n+1) *
/// resolution. Voxels are numbered x fastest, then y, then z.
struct VoxelGrid {
  double resolution = 0.01;                         ///< voxel edge [m]
  Eigen::Vector3i first = Eigen::Vector3i::Zero();  ///< lattice coordinates of the lowest voxel
  Eigen::Vector3i size = Eigen::Vector3i::Zero();   ///< voxels along each axis

  std::size_t voxel_count() const { return std::size_t(size.x()) * size.y() * size.z(); }
  bool contains(const Eigen::Vector3i& cell) const {
    return (cell.array() >= 0).all() && (cell.array() < size.array()).all();
  }
  std::uint32_t index(const Eigen::Vector3i& cell) const {
    return static_cast<std::uint32_t>((std::size_t(cell.z()) * size.y() + cell.y()) * size.x() + cell.x());
  }
  /// Position within the grid, counted from its lowest voxel.
  Eigen::Vector3i cell(std::uint32_t index) const {
    const int nx = size.x(), ny = size.y(), i = static_cast<int>(index);
    return {i % nx, i / nx % ny, i / (nx * ny)};
  }
  Eigen::Vector3i cell_at(const Vector3& point) const {
    constexpr double far = 1e9;  // farther off is no cell of any grid, and would not fit an int
    // Times the inverse, not divided: the same rounding as OctoMap's keys.
    return (point * (1.0 / resolution)).array().floor().max(-far).min(far).matrix().cast<int>() - first;
  }
  Vector3 lower() const { return first.cast<double>() * resolution; }
  Vector3 upper() const { return (first + size).cast<double>() * resolution; }
  Eigen::AlignedBox3d box() const { return {lower(), upper()}; }
  Vector3 centre(std::uint32_t index) const {
    return ((first + cell(index)).cast<double>() + Vector3::Constant(0.5)) * resolution;
  }
};

/// As many as a region of interest may have along a side.
inline constexpr int most_voxels_along_side = 1024;

/// The region of interest: a cube of `edge` [m] around `centre`, snapped to the lattice (edge to the next whole number
/// of voxels).
/// @throws std::invalid_argument if it has no voxels, or too many along a side, or lies too far off for octrees.
VoxelGrid region_of_interest(const Vector3& centre, double edge, double resolution);
/// The same of a box [m, world]: all voxels that it reaches into.
/// @throws std::invalid_argument as above
VoxelGrid region_of_interest(const Eigen::AlignedBox3d& box, double resolution);

}  // namespace nextview
