#include "ui/layers/side_actor.hpp"

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

namespace nextview {

vtkStandardNewMacro(SideActor);

bool SideActor::is_seen(vtkViewport& viewport) {
  auto* renderer = vtkRenderer::SafeDownCast(&viewport);
  if (!drawn_) return false;
  if (side_ < 0 || !renderer) return true;
  vtkCamera& camera = *renderer->GetActiveCamera();
  const int axis = side_ / 2;
  const bool positive = side_ % 2 == 1;
  if (camera.GetParallelProjection()) return (camera.GetDirectionOfProjection()[axis] < 0) == positive;
  const double at = camera.GetPosition()[axis];
  const double* bounds = GetBounds();
  return positive ? at > bounds[2 * axis] : at < bounds[2 * axis + 1];
}

int SideActor::RenderOpaqueGeometry(vtkViewport* viewport) {
  return is_seen(*viewport) ? Superclass::RenderOpaqueGeometry(viewport) : 0;
}

int SideActor::RenderTranslucentPolygonalGeometry(vtkViewport* viewport) {
  return is_seen(*viewport) ? Superclass::RenderTranslucentPolygonalGeometry(viewport) : 0;
}

}  // namespace nextview
