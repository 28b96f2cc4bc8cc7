#pragma once
#include <vtkSmartPointer.h>

#include "ui/render_target/image.hpp"

class vtkGenericOpenGLRenderWindow;

namespace nextview {

/// Where pixels end: a window or an image. VTK draws through `window()` into either, with the same pixels.
class RenderTarget {
 public:
  static constexpr int smooth_samples = 4;  ///< of a pixel, for smooth edges; from the start

  virtual ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  int width() const;   ///< [px] of the framebuffer
  int height() const;  ///< [px] of the framebuffer
  vtkGenericOpenGLRenderWindow& window();

  virtual void make_current() = 0;
  virtual bool is_current() const = 0;
  /// An OpenGL function of the target's context by its name.
  virtual void* gl_function(const char* name) const = 0;

  /// Whether all that was given to the graphics card is gone, as after a reset of it: nothing is drawn any more.
  virtual bool is_lost() { return false; }
  /// Takes another context. What VTK has in the old one is given up here, and made again when it is drawn; others must
  /// give up theirs before. @throws std::runtime_error if there is none
  void renew();

  /// Whether a processor does what graphics cards do (Mesa's llvmpipe or softpipe): each pixel counts.
  bool draws_in_software();

  /// Draws every renderer of the window.
  /// @throws std::runtime_error if VTK reports an error; for a shader it names the file, the line and the compiler's
  /// words.
  void render();

  /// What the last rendering, and whoever drew over it, left in the back buffer. Alpha is 255 everywhere.
  Image read_back();

  /// The same of the framebuffer that is bound to be read.
  Image read_pixels();

  /// The first OpenGL error since the last call, 0 if there was none.
  unsigned int gl_error();

 protected:
  RenderTarget();
  /// Call at the end of the derived constructor, when there is a context.
  void start(int width, int height);
  /// Call at the beginning of the derived destructor, while there is a context.
  void finish();

 private:
  virtual void replace_context() = 0;

  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace nextview
