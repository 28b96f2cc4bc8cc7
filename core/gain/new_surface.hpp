#pragma once
#include <span>
#include <stop_token>
#include <vector>

#include "core/gain/new_surface_model.hpp"
#include "core/gain/ray.hpp"
#include "core/gain/ray_lanes.hpp"
#include "core/gain/view_score.hpp"

namespace nextview {

/// A map as expected new surface sees it: what a ray that gets to a voxel is expected to find there.
class NewSurfaceField {
 public:
  NewSurfaceField(const SurfaceEvidence& evidence, const NewSurfaceModel& model);

  const VoxelGrid& grid() const { return grid_; }  ///< no surface is expected outside
  /// NewSurfaceModel::chance
  float at(int x, int y, int z) const { return chances_[place_with_margin(grid_, x, y, z)]; }
  float at(std::size_t voxel) const {
    const Eigen::Vector3i cell = grid_.cell(static_cast<std::uint32_t>(voxel));
    return at(cell.x(), cell.y(), cell.z());
  }
  std::span<const float> chances() const { return chances_; }  ///< as ChanceField has them
  /// SurfaceEvidence::normal of a voxel's block. @pre at(x, y, z) != 0
  CoarseNormal normal(int x, int y, int z) const { return normals_[place_with_margin(grid_, x, y, z)]; }
  std::span<const CoarseNormal> normals() const { return normals_; }  ///< by place with margin

 private:
  void fill_layer_of_blocks(const SurfaceEvidence& evidence, const NewSurfaceModel& model, int block_z);

  VoxelGrid grid_;
  std::vector<float, HugePages<float>> chances_;                ///< with margin
  std::vector<CoarseNormal, HugePages<CoarseNormal>> normals_;  ///< likewise; without a value where none is asked for
};

/// How far rays are followed, and what an area across them is worth.
struct NewSurfaceOptions {
  double ray_length = 1.5;  ///< [m]
  SurfaceSlant slant = {};
};

/// The new surface that each view is expected to see [cm^2]: over its rays of solid angle dOmega and over the voxels on
/// them, at range r, slant r^2 dOmega reach q, where reach is the probability of getting there, 1 at first, and
/// reach (1 - q) beyond a voxel, and slant is that of the voxel's normal. The same on any number of threads. A
/// requested stop leaves the rest at 0.
std::vector<double> expected_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                         const RayBundle& bundle, const NewSurfaceOptions& options,
                                         std::stop_token stop = {});

/// What views are expected to show, each for itself and all together [cm^2].
struct NewSurfaceForecast {
  std::vector<double> areas;  ///< expected_new_surface
  /// Of each view, how much of that is in each part of the map, a block of 8 x 8 x 8 voxels.
  std::vector<std::vector<float>> parts;
  std::vector<float> most;  ///< of each part, what the view shows that shows most of it
  /// The sum of that. As views see parts from several sides it is too little, and too much as no view knows what
  /// another would have seen.
  double all = 0.0;
};
NewSurfaceForecast forecast_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                        const RayBundle& bundle, const NewSurfaceOptions& options,
                                        std::stop_token stop = {});

/// New surface that a view is expected to see in a voxel.
struct NewSurfaceInVoxel {
  Vector3 middle;  ///< of the voxel [m, world]
  double area;     ///< [cm^2]
};
/// That of a view, voxel by voxel along each of its rays: their sum is expected_new_surface.
std::vector<NewSurfaceInVoxel> new_surface_in_voxels(const NewSurfaceField& field, const Pose& T_world_camera,
                                                     const RayBundle& bundle, const NewSurfaceOptions& options);

/// A view's expected new surface taken apart [cm^2]: the voxels with their probability of being occupied, which
/// `voxels` of the whole `grid` say, and their visibility, which is reach.
ScoreExplanation explain_new_surface(const NewSurfaceField& field, const VoxelGrid& grid, const VoxelBricks& voxels,
                                     const Pose& T_world_camera, const RayBundle& bundle,
                                     const NewSurfaceOptions& options);

}  // namespace nextview
