#pragma once
#include <vtkOpenGLRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

class vtkOpenGLFramebufferObject;

namespace nextview {

/// VTK's renderer, made for a processor that draws:
/// - Clear surfaces are laid over what is there. VTK weighs them by their depth in buffers of their own, to be
///   independent of their order, which takes half of the time. What is clear here is of one colour a layer, and then
///   the order of its faces makes no difference.
/// - While it is coarse, what is 3D is drawn with half of the pixels each way and enlarged; text stays as it is.
class SceneRenderer : public vtkOpenGLRenderer {
 public:
  static SceneRenderer* New();
  vtkTypeMacro(SceneRenderer, vtkOpenGLRenderer)

      void set_coarse(bool coarse) {
    coarse_ = coarse;
  }

  /// At four pixels around each place of the picture [px, from its lower left corner]: how deep what is opaque lies
  /// there, 0 nearest to 1 farthest. While what is flat is drawn only: all else is there by then.
  std::vector<std::array<float, 4>> depths(std::span<const Eigen::Vector2d> places);

  void DeviceRenderTranslucentPolygonalGeometry(vtkFrameBufferObjectBase* buffer) override;
  int UpdateGeometry(vtkFrameBufferObjectBase* buffer) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  SceneRenderer();
  ~SceneRenderer() override;

 private:
  /// A part of the picture [px], from its lower left corner.
  struct Part {
    int x = 0, y = 0, width = 0, height = 0;
  };
  void draw_into(const Part& part);
  void enlarge(const Part& small, const Part& whole);

  bool coarse_ = false;
  vtkSmartPointer<vtkOpenGLFramebufferObject> small_, depths_;
};

}  // namespace nextview
