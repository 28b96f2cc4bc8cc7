#pragma once
#include "core/mesh/triangle_mesh.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkOpenGLPolyDataMapper;

namespace nextview {

enum class MeshStyle {
  solid,
  wire,
  ghost  ///< clear where it faces the viewer, denser towards its outline
};

/// The object, or a reconstructed surface.
class MeshLayer : public Layer {
 public:
  explicit MeshLayer(vtkRenderer& renderer);

  void show(const TriangleMesh& mesh, MeshStyle style = MeshStyle::solid);
  void set_style(MeshStyle style);

 private:
  vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
