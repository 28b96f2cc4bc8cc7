#pragma once
#include "ui/layers/layer.hpp"
#include "ui/layers/voxel_faces.hpp"

class vtkActor;
class vtkOpenGLPolyDataMapper;

namespace nextview {

enum class VoxelColouring { by_class, by_probability };

/// The map's voxels as cubes with crisp edges; only exposed faces are drawn. Free voxels, if shown, are a translucent
/// shell.
class OctreeLayer : public Layer {
 public:
  explicit OctreeLayer(vtkRenderer& renderer);

  /// @throws std::invalid_argument if the number of voxels is not the grid's.
  void show(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter = {},
            VoxelColouring colouring = VoxelColouring::by_class);
  /// Another colouring of what is shown; much cheaper than showing it anew.
  void set_colouring(VoxelColouring colouring);

 private:
  struct Part {
    vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
  };
  Part make_part();

  Part solid_, free_;
  VoxelFilter filter_;
};

}  // namespace nextview
