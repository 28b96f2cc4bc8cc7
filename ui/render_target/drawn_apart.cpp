#include "ui/render_target/drawn_apart.hpp"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <algorithm>

#include "core/memory/available_memory.hpp"
#include "ui/render_target/gl_constants.hpp"

namespace nextview {
namespace {

/// With four samples each, of colour and depth, and the copies on the way to a file [bytes].
constexpr std::uint64_t bytes_a_pixel = 64;

std::vector<vtkRenderer*> renderers_of(vtkRenderWindow& window) {
  std::vector<vtkRenderer*> renderers;
  vtkRendererCollection& all = *window.GetRenderers();
  vtkCollectionSimpleIterator at;
  all.InitTraversal(at);
  while (vtkRenderer* renderer = all.GetNextRenderer(at)) renderers.push_back(renderer);
  return renderers;
}

/// Gives renderers one plain background for as long as it lives.
class PlainBackground {
 public:
  PlainBackground(const std::vector<vtkRenderer*>& renderers, double grey) {
    for (vtkRenderer* renderer : renderers) {
      Before& before = before_.emplace_back(Before{renderer, renderer->GetGradientBackground(), {}});
      renderer->GetBackground(before.colour.data());
      renderer->SetGradientBackground(false);
      renderer->SetBackground(grey, grey, grey);
    }
  }
  ~PlainBackground() {
    for (Before& before : before_) {
      before.renderer->SetGradientBackground(before.gradient);
      before.renderer->SetBackground(before.colour.data());
    }
  }
  PlainBackground(const PlainBackground&) = delete;
  PlainBackground& operator=(const PlainBackground&) = delete;

 private:
  struct Before {
    vtkRenderer* renderer;
    bool gradient;
    std::array<double, 3> colour;
  };
  std::vector<Before> before_;
};

/// The picture that gives both of these when it is laid over black and over white.
Image without_background(const Image& on_black, const Image& on_white) {
  Image image = on_black;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    int through = 0;  // of the background
    for (std::size_t c = i; c < i + 3; ++c) through = std::max(through, on_white.rgba[c] - on_black.rgba[c]);
    const int alpha = 255 - through;
    image.rgba[i + 3] = static_cast<std::uint8_t>(alpha);
    for (std::size_t c = i; c < i + 3; ++c)
      image.rgba[c] =
          alpha == 0 ? 0 : static_cast<std::uint8_t>(std::min(255, (255 * on_black.rgba[c] + alpha / 2) / alpha));
  }
  return image;
}

}  // namespace

DrawnApart::DrawnApart(RenderTarget& target, const std::vector<vtkRenderer*>& drawn, const PictureSize& size)
    : target_(target),
      size_(size),
      size_before_{target.width(), target.height()},
      blitting_before_(target.window().GetFrameBlitMode()),
      pixels_(vtkSmartPointer<vtkOpenGLFramebufferObject>::New()) {
  require_memory(std::uint64_t(size.width) * std::uint64_t(size.height) * bytes_a_pixel, "a picture of this size",
                 "choose a smaller one");
  for (vtkRenderer* renderer : renderers_of(target.window())) {
    if (!renderer->GetDraw() || std::ranges::find(drawn, renderer) != drawn.end()) continue;
    renderer->DrawOff();
    hidden_.emplace_back(renderer);
  }
  target.window().SetFrameBlitModeToNoBlit();
  target.window().SetSize(size.width, size.height);
  pixels_->SetContext(&target.window());
}

DrawnApart::~DrawnApart() {
  target_.make_current();
  pixels_->ReleaseGraphicsResources(&target_.window());
  target_.window().SetSize(size_before_[0], size_before_[1]);
  target_.window().SetFrameBlitMode(static_cast<vtkOpenGLRenderWindow::FrameBlitModes>(blitting_before_));
  for (vtkRenderer* renderer : hidden_) renderer->DrawOn();
  target_.make_current();
}

Image DrawnApart::draw(bool transparent) {
  if (!transparent) return draw_and_read();
  std::vector<vtkRenderer*> drawn = renderers_of(target_.window());
  std::erase_if(drawn, [](vtkRenderer* renderer) { return !renderer->GetDraw(); });
  const auto on = [&](double grey) {
    const PlainBackground background(drawn, grey);
    return draw_and_read();
  };
  const Image on_black = on(0.0);
  return without_background(on_black, on(1.0));
}

Image DrawnApart::draw_and_read() {
  target_.render();
  vtkGenericOpenGLRenderWindow& window = target_.window();
  const int width = size_.width, height = size_.height;
  if (pixels_->GetFBOIndex() == 0) pixels_->PopulateFramebuffer(width, height, true, 1, VTK_UNSIGNED_CHAR, false, 0, 0);
  vtkOpenGLState& state = *window.GetState();
  state.PushFramebufferBindings();
  pixels_->Bind(gl_draw_framebuffer);
  pixels_->ActivateDrawBuffer(0);
  window.BlitDisplayFramebuffer(0, 0, 0, width, height, 0, 0, width, height, gl_color_buffer_bit, gl_nearest);
  pixels_->Bind(gl_read_framebuffer);
  pixels_->ActivateReadBuffer(0);
  Image image = target_.read_pixels();
  state.PopFramebufferBindings();
  return image;
}

}  // namespace nextview
