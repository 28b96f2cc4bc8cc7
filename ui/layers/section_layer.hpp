#pragma once
#include "core/mesh/triangle_mesh.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;
class vtkOpenGLPolyDataMapper;

namespace nextview {

/// Where a section cuts the object and the reconstructed surface: the object's inside hatched, as drawings have it, and
/// a line where the surface runs.
class SectionLayer : public Layer {
 public:
  explicit SectionLayer(vtkRenderer& renderer);

  /// Either may be null. An object that is not closed there is drawn as far as its cut is.
  void show(const Section& section, const TriangleMesh* object, const TriangleMesh* surface);
  void clear();

 private:
  void on_scale() override;

  struct Lines {
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
  };
  Lines make_lines(double width);

  vtkSmartPointer<vtkOpenGLPolyDataMapper> inside_mapper_;
  vtkSmartPointer<vtkActor> inside_;
  Lines outline_, surface_;
};

}  // namespace nextview
