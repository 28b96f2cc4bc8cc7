#include "ui/render_target/render_target.hpp"

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkOpenGLState.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "ui/drawing/shader_file.hpp"
#include "ui/render_target/gl_constants.hpp"
#include "ui/render_target/vtk_messages.hpp"

namespace nextview {
namespace {

void answer_vtk(vtkObject*, unsigned long event, void* target_pointer, void* answer) {
  auto& target = *static_cast<RenderTarget*>(target_pointer);
  if (event == vtkCommand::WindowMakeCurrentEvent && !target.is_current()) target.make_current();
  if (event == vtkCommand::WindowIsCurrentEvent) *static_cast<bool*>(answer) = target.is_current();
}

}  // namespace

RenderTarget::RenderTarget() : window_(vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New()) {}

RenderTarget::~RenderTarget() = default;

vtkGenericOpenGLRenderWindow& RenderTarget::window() { return *window_; }
int RenderTarget::width() const { return window_->GetSize()[0]; }
int RenderTarget::height() const { return window_->GetSize()[1]; }

void RenderTarget::start(int width, int height) {
  vtkNew<vtkCallbackCommand> callback;
  callback->SetCallback(answer_vtk);
  callback->SetClientData(this);
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, callback);
  window_->AddObserver(vtkCommand::WindowIsCurrentEvent, callback);
  window_->SetIsDirect(1);
  window_->SetSupportsOpenGL(1);
  window_->SetReadyForRendering(true);
  window_->SetOwnContext(0);
  window_->SetDPI(72);  // so that a font size is a height in pixels
  window_->SetMultiSamples(smooth_samples);
  window_->SetSize(width, height);
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();  // edges lie before the faces that they bound
  make_current();
  window_->OpenGLInitContext();
}

bool RenderTarget::draws_in_software() {
  using GetString = const unsigned char* (*)(unsigned int);
  make_current();
  const auto* name =
      reinterpret_cast<const char*>(reinterpret_cast<GetString>(gl_function("glGetString"))(gl_renderer));
  const std::string_view renderer = name ? name : "";
  return renderer.find("llvmpipe") != renderer.npos || renderer.find("softpipe") != renderer.npos;
}

void RenderTarget::finish() {
  make_current();
  window_->Finalize();
}

void RenderTarget::renew() {
  finish();
  replace_context();
  make_current();
  window_->OpenGLInitContext();
}

void RenderTarget::render() {
  using PointParameter = void (*)(unsigned int, int);
  const VtkMessages messages;
  make_current();
  // Charts turn the sprites of points upside down and leave them so; a scene's points would then be lit from below.
  reinterpret_cast<PointParameter>(gl_function("glPointParameteri"))(gl_point_sprite_coord_origin, gl_upper_left);
  window_->Render();
  if (!messages.errors().empty()) throw std::runtime_error(explain_drawing_error(messages.errors()));
}

Image RenderTarget::read_back() {
  make_current();
  vtkOpenGLState* state = window_->GetState();
  state->PushReadFramebufferBinding();
  state->vtkglBindFramebuffer(gl_read_framebuffer, 0);
  state->vtkglReadBuffer(gl_back);
  Image image = read_pixels();
  state->PopReadFramebufferBinding();
  return image;
}

Image RenderTarget::read_pixels() {
  using ReadPixels = void (*)(int, int, int, int, unsigned int, unsigned int, void*);
  Image image{width(), height(), {}};
  const std::size_t row = std::size_t(image.width) * 4;
  image.rgba.resize(row * image.height);
  reinterpret_cast<ReadPixels>(gl_function("glReadPixels"))(0, 0, image.width, image.height, gl_rgba, gl_unsigned_byte,
                                                            image.rgba.data());
  std::vector<std::uint8_t> lower(row);  // rows go from bottom to top there
  for (int y = 0; y < image.height / 2; ++y) {
    std::uint8_t *const here = &image.rgba[y * row], *const there = &image.rgba[(image.height - 1 - y) * row];
    std::copy_n(here, row, lower.data());
    std::copy_n(there, row, here);
    std::copy_n(lower.data(), row, there);
  }
  // A window's back buffer may have no alpha, and an opaque picture needs none.
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

unsigned int RenderTarget::gl_error() {
  make_current();
  return reinterpret_cast<unsigned int (*)()>(gl_function("glGetError"))();
}

}  // namespace nextview
