#include "ui/scene/scene_renderer.hpp"

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkProp.h>

#include "ui/render_target/gl_constants.hpp"

namespace nextview {

vtkStandardNewMacro(SceneRenderer);

SceneRenderer::SceneRenderer() : small_(vtkSmartPointer<vtkOpenGLFramebufferObject>::New()) {}

SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::DeviceRenderTranslucentPolygonalGeometry(vtkFrameBufferObjectBase*) {
  UpdateTranslucentPolygonalGeometry();
}

int SceneRenderer::UpdateGeometry(vtkFrameBufferObjectBase* buffer) {
  if (!coarse_) return Superclass::UpdateGeometry(buffer);
  Part whole;
  GetTiledSizeAndOrigin(&whole.width, &whole.height, &whole.x, &whole.y);
  const Part small{whole.x, whole.y, (whole.width + 1) / 2, (whole.height + 1) / 2};
  draw_into(small);
  Clear();  // the ground again, at this size
  NumberOfPropsRendered = 0;
  for (int i = 0; i < PropArrayCount; ++i) NumberOfPropsRendered += PropArray[i]->RenderOpaqueGeometry(this);
  UpdateTranslucentPolygonalGeometry();
  draw_into(whole);
  enlarge(small, whole);
  for (int i = 0; i < PropArrayCount; ++i) NumberOfPropsRendered += PropArray[i]->RenderOverlay(this);
  RenderTime.Modified();
  return NumberOfPropsRendered;
}

void SceneRenderer::draw_into(const Part& part) {
  vtkOpenGLState& state = *static_cast<vtkOpenGLRenderWindow*>(RenderWindow)->GetState();
  state.vtkglViewport(part.x, part.y, part.width, part.height);
  state.vtkglScissor(part.x, part.y, part.width, part.height);
}

/// By a copy: a framebuffer must not be read where it is written.
void SceneRenderer::enlarge(const Part& small, const Part& whole) {
  auto& window = *static_cast<vtkOpenGLRenderWindow*>(RenderWindow);
  vtkOpenGLState& state = *window.GetState();
  vtkOpenGLFramebufferObject& picture = *window.GetRenderFramebuffer();
  state.PushFramebufferBindings();
  small_->SetContext(&window);
  if (small_->GetFBOIndex() == 0) {
    small_->PopulateFramebuffer(small.width, small.height, true, 1, VTK_UNSIGNED_CHAR, false, 0, 0);
  } else {
    small_->Resize(small.width, small.height);
  }
  const auto copy = [&](vtkOpenGLFramebufferObject& from, const Part& source, vtkOpenGLFramebufferObject& to,
                        const Part& target, unsigned int filter) {
    from.Bind(gl_read_framebuffer);
    from.ActivateReadBuffer(0);
    to.Bind(gl_draw_framebuffer);
    to.ActivateDrawBuffer(0);
    state.vtkglBlitFramebuffer(source.x, source.y, source.x + source.width, source.y + source.height, target.x,
                               target.y, target.x + target.width, target.y + target.height, gl_color_buffer_bit,
                               filter);
  };
  const Part there{0, 0, small.width, small.height};
  draw_into(there);  // what lies outside is not written
  copy(picture, small, *small_, there, gl_nearest);
  draw_into(whole);
  copy(*small_, there, picture, whole, gl_linear);
  state.PopFramebufferBindings();
}

void SceneRenderer::ReleaseGraphicsResources(vtkWindow* window) {
  if (window) small_->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}

}  // namespace nextview
