#pragma once
#include "ui/layers/layer.hpp"
#include "ui/layers/voxel_faces.hpp"
#include "ui/layers/voxel_palette.hpp"

class vtkActor;
class vtkOpenGLPolyDataMapper;

namespace nextview {

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
  /// Another colouring, or other values, of what is shown; much cheaper than showing it anew.
  /// @throws std::invalid_argument if the number of values is not that of the shown grid's voxels.
  void set_colouring(VoxelColouring colouring, std::span<const float> values = {});

  std::size_t face_count() const { return solid_.faces.size() + free_.faces.size(); }

 private:
  struct Part {
    vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
    double nook_darkness;  ///< a clear shell has none
    std::vector<VoxelFace> faces;
    std::vector<Voxel> voxels;  ///< one a face
  };
  Part make_part(double nook_darkness);
  static void show_part(Part& part, const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter);
  /// Returns whether all voxels have a colour.
  static bool colour_part(Part& part, const VoxelPalette& palette, std::span<const float> values);
  void on_scale() override;

  Part solid_, free_;
  VoxelFilter filter_;
  std::size_t voxel_count_ = 0;  ///< of the shown grid
};

}  // namespace nextview
