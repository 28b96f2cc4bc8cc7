#pragma once
#include <random>
#include <vector>

#include "core/map/ground_truth.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

/// Maps for the tests of surfaces.
namespace nextview::made_maps {

inline constexpr double edge = 0.01;  ///< of a voxel of the grids below [m]

inline Voxel measured(float probability) {
  Voxel voxel;
  voxel.probability = probability;
  voxel.measured = true;
  return voxel;
}

inline VoxelGrid grid_of(const Eigen::Vector3i& size, const Eigen::Vector3i& first = {-3, 2, -5}) {
  VoxelGrid grid;
  grid.first = first;
  grid.size = size;
  return grid;
}

/// All free.
inline std::vector<Voxel> free_space(const VoxelGrid& grid) {
  return std::vector<Voxel>(grid.voxel_count(), measured(0.0f));
}

/// What a perfect scan from all sides leaves of a solid: what its surface touches is occupied, what is hidden inside is
/// not measured, the rest is free.
inline std::vector<Voxel> scanned(const TriangleMesh& solid, const VoxelGrid& grid) {
  const GroundTruth truth = ground_truth(solid, grid);
  std::vector<Voxel> voxels = free_space(grid);
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    if (truth.touch[v]) voxels[v] = measured(1.0f);
    if (truth.hidden(v)) voxels[v] = Voxel{};
  }
  return voxels;
}

/// Voxels with a probability from a few levels or any, or not measured; `solid` is the share of occupied ones.
inline std::vector<Voxel> random_voxels(std::mt19937& random, const VoxelGrid& grid, double unmeasured, double solid) {
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const bool crisp = random() % 2;
  std::vector<Voxel> voxels(grid.voxel_count());
  for (Voxel& v : voxels) {
    if (uniform(random) < unmeasured) continue;
    const bool occupied = uniform(random) < solid;
    v = crisp ? measured(occupied ? 0.97f : 0.12f) : measured((occupied ? 0.5f : 0.0f) + 0.4999f * uniform(random));
  }
  return voxels;
}

/// Blobs: balls of random size and place, soft at the rim; some voxels not measured.
inline std::vector<Voxel> random_blobs(std::mt19937& random, const VoxelGrid& grid) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Voxel> voxels = free_space(grid);
  for (int ball = 0; ball < 3; ++ball) {
    const Vector3 centre(uniform(random) * grid.size.x(), uniform(random) * grid.size.y(),
                         uniform(random) * grid.size.z());
    const double radius = 0.5 + 3.0 * uniform(random);
    for (std::uint32_t v = 0; v < voxels.size(); ++v) {
      const double inside = radius - (grid.cell(v).cast<double>() + Vector3::Constant(0.5) - centre).norm();
      const float p = float(std::clamp(0.5 + 0.4 * inside, 0.0, 1.0));
      voxels[v].probability = std::max(voxels[v].probability, p);
      if (inside > 1.5) voxels[v] = Voxel{};
    }
  }
  for (Voxel& v : voxels)
    if (uniform(random) < 0.03) v = Voxel{};
  return voxels;
}

}  // namespace nextview::made_maps
