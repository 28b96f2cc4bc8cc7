#include "ui/scene/scene_renderer.hpp"

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPixelBufferObject.h>
#include <vtkProp.h>

#include <algorithm>
#include <cmath>

#include "ui/render_target/gl_constants.hpp"

namespace nextview {

vtkStandardNewMacro(SceneRenderer);

SceneRenderer::SceneRenderer()
    : small_(vtkSmartPointer<vtkOpenGLFramebufferObject>::New()),
      depths_(vtkSmartPointer<vtkOpenGLFramebufferObject>::New()) {}

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

/// Copied beside each other first, as buffers of several samples a pixel cannot be read; and read at once, as each
/// reading waits until all is drawn.
std::vector<std::array<float, 4>> SceneRenderer::depths(std::span<const Eigen::Vector2d> places) {
  constexpr int side = 7;  // [px] of the square around a place: a thin line that crosses it is not at its corners
  if (places.empty()) return {};
  auto& window = *static_cast<vtkOpenGLRenderWindow*>(RenderWindow);
  vtkOpenGLState& state = *window.GetState();
  vtkOpenGLFramebufferObject& picture = *window.GetRenderFramebuffer();
  Part whole;
  GetTiledSizeAndOrigin(&whole.width, &whole.height, &whole.x, &whole.y);
  const int width = side * int(places.size());
  state.PushFramebufferBindings();
  depths_->SetContext(&window);
  if (depths_->GetFBOIndex() == 0) {
    depths_->PopulateFramebuffer(width, side, true, 1, VTK_UNSIGNED_CHAR, true, 32, 0);  // deep as the picture
  } else {
    depths_->Resize(width, side);
  }
  picture.Bind(gl_read_framebuffer);
  depths_->Bind(gl_draw_framebuffer);
  draw_into({0, 0, width, side});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d place = places[i] * (coarse_ ? 0.5 : 1.0);
    const int x = whole.x + int(std::floor(place.x())) - side / 2, y = whole.y + int(std::floor(place.y())) - side / 2;
    const int to = side * int(i);
    state.vtkglBlitFramebuffer(x, y, x + side, y + side, to, 0, to + side, side, gl_depth_buffer_bit, gl_nearest);
  }
  depths_->Bind(gl_read_framebuffer);
  int all[] = {0, width - 1, 0, side - 1};
  const auto read = vtkSmartPointer<vtkPixelBufferObject>::Take(depths_->DownloadDepth(all, VTK_FLOAT));
  const auto* values = static_cast<const float*>(read->MapPackedBuffer());
  std::vector<std::array<float, 4>> result;
  for (int left = 0; left < width; left += side) {
    const int right = left + side - 1, top = (side - 1) * width;
    result.push_back({values[left], values[right], values[top + left], values[top + right]});
  }
  read->UnmapPackedBuffer();
  state.PopFramebufferBindings();
  draw_into(whole);
  return result;
}

void SceneRenderer::ReleaseGraphicsResources(vtkWindow* window) {
  if (window) small_->ReleaseGraphicsResources(window);
  if (window) depths_->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}

}  // namespace nextview
