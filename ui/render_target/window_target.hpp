#pragma once
#include <string>

#include "ui/render_target/render_target.hpp"

struct GLFWwindow;

namespace nextview {

/// A window on the display: OpenGL 3.3 core through GLFW. There is one at a time.
class WindowTarget : public RenderTarget {
 public:
  /// Sizes in screen coordinates (pixels, except on a display with scaling).
  /// @throws std::runtime_error if there is no display or it has no OpenGL 3.3.
  WindowTarget(const std::string& title, int width, int height);
  ~WindowTarget() override;

  void make_current() override;
  bool is_current() const override;
  void* gl_function(const char* name) const override;
  /// Asks the driver, where it tells.
  bool is_lost() override;

  /// Another one after renew(), which opens a window in the place of the old.
  GLFWwindow* handle() { return handle_; }
  /// Takes over the framebuffer's size; call it when the window was resized.
  void follow_size();
  /// Shows the back buffer on the display.
  void present();

 private:
  void replace_context() override;

  void look_up_reset_status();

  std::string title_;
  unsigned int (*reset_status_)() = nullptr;  ///< of the driver, if it tells
  GLFWwindow* handle_ = nullptr;
};

}  // namespace nextview
