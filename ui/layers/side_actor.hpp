#pragma once
#include <vtkOpenGLActor.h>

namespace nextview {

/// Faces that are drawn only at times; what is not drawn is not even looked at by the renderer. If all look along one
/// axis, they are not while the camera is behind all of them: of a map that is seen from outside that is half of it.
class SideActor : public vtkOpenGLActor {
 public:
  static SideActor* New();
  vtkTypeMacro(SideActor, vtkOpenGLActor)

      /// `side`: as VoxelFace::side, none unless told. Where the faces lie comes from the bounds of what is drawn.
      void set_side(int side) {
    side_ = side;
  }
  /// They are unless told otherwise.
  void set_drawn(bool drawn) { drawn_ = drawn; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport* viewport) override;

 private:
  bool is_seen(vtkViewport& viewport);

  int side_ = -1;
  bool drawn_ = true;
};

}  // namespace nextview
