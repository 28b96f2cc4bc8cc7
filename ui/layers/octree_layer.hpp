#pragma once
#include "ui/layers/layer.hpp"
#include "ui/layers/voxel_faces.hpp"
#include "ui/layers/voxel_palette.hpp"

class vtkOpenGLPolyDataMapper;

namespace nextview {

class SideActor;

/// The faces of voxels that are drawn.
struct OctreeFaces {
  std::vector<VoxelFace> solid, free;
};
/// @throws as exposed_faces
OctreeFaces octree_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter);

/// The map's voxels as cubes with crisp edges, darker in nooks; only exposed faces are drawn. Free voxels, if shown,
/// are a translucent shell.
class OctreeLayer : public Layer {
 public:
  explicit OctreeLayer(vtkRenderer& renderer);

  /// `values`: one per voxel of the grid, for the colourings by a value; not a number where there is none. Without
  /// values no voxel has one.
  /// @throws std::invalid_argument if the number of voxels or values is not the grid's, or the slice's axis is none.
  void show(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter = {},
            VoxelColouring colouring = VoxelColouring::by_class, std::span<const float> values = {});
  /// The same with faces that were found before, by octree_faces of the same voxels and filter.
  void show(const OctreeFaces& faces, const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter,
            VoxelColouring colouring, std::span<const float> values = {});
  /// Another colouring, or other values, of what is shown; much cheaper than showing it anew.
  /// @throws std::invalid_argument if the number of values is not that of the shown grid's voxels.
  void set_colouring(VoxelColouring colouring, std::span<const float> values = {});

  std::size_t face_count() const;  ///< at rest
  /// Draws many voxels as fewer, larger ones from now on.
  void set_coarse(bool coarse);

 private:
  struct Part {
    vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper;
    vtkSmartPointer<SideActor> actor;
    double nook_darkness;              ///< a clear shell has none
    std::vector<std::uint32_t> cells;  ///< of the map, one a face: whose colours the faces have
    std::vector<Voxel> voxels;         ///< the same
  };
  /// The solid voxels' six sides, then the free shell.
  using Parts = std::vector<Part>;
  Parts make_parts();
  Part make_part(double nook_darkness);
  /// The faces of a grid, and of each the voxel of the map whose colour it has.
  static void show_parts(Parts& parts, const VoxelGrid& grid, std::span<const VoxelFace> solid,
                         std::span<const VoxelFace> free, std::span<const std::uint32_t> cells,
                         std::span<const Voxel> voxels);
  void show_coarse(const VoxelGrid& grid, std::span<const VoxelFace> solid, std::span<const VoxelFace> free,
                   std::span<const Voxel> voxels);
  /// Returns whether all voxels have a colour.
  static bool colour_part(Part& part, const VoxelPalette& palette, std::span<const float> values);
  void on_scale() override;

  Parts parts_;
  Parts coarse_;  ///< the same with fewer, larger voxels; empty if there are few anyway
  bool has_coarse_ = false, wants_coarse_ = false;
  VoxelFilter filter_;
  std::size_t voxel_count_ = 0;  ///< of the shown grid
};

}  // namespace nextview
