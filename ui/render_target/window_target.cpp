#include "ui/render_target/window_target.hpp"

#include <GLFW/glfw3.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <stdexcept>
#include <utility>

namespace nextview {
namespace {

std::runtime_error no_window() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return std::runtime_error(std::string("cannot open a window: ") + (reason ? reason : "unknown reason") +
                            "; `nextview scan`, `export`, `figure` and `demo --out DIR` draw without a display");
}

/// @throws std::runtime_error
GLFWwindow* new_window(const std::string& title, int width, int height, GLFWmonitor* monitor) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // Where a driver can, it tells of a loss; not all that say so can.
  for (const int told : {GLFW_LOSE_CONTEXT_ON_RESET, GLFW_NO_ROBUSTNESS}) {
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, told);
    if (GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), monitor, nullptr)) return window;
  }
  throw no_window();
}

}  // namespace

WindowTarget::WindowTarget(const std::string& title, int width, int height) : title_(title) {
  if (!glfwInit()) throw no_window();
  try {
    handle_ = new_window(title_, width, height, nullptr);
  } catch (...) {
    glfwTerminate();
    throw;
  }
  glfwGetFramebufferSize(handle_, &width, &height);
  start(width, height);
  look_up_reset_status();
}

WindowTarget::~WindowTarget() {
  finish();
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

void WindowTarget::replace_context() {
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetWindowPos(handle_, &x, &y);
  glfwGetWindowSize(handle_, &width, &height);
  GLFWwindow* const another = new_window(title_, width, height, glfwGetWindowMonitor(handle_));
  if (!glfwGetWindowMonitor(another)) glfwSetWindowPos(another, x, y);
  glfwDestroyWindow(std::exchange(handle_, another));
  look_up_reset_status();
}

void WindowTarget::look_up_reset_status() {
  make_current();
  reset_status_ = glfwExtensionSupported("GL_ARB_robustness")
                      ? reinterpret_cast<unsigned int (*)()>(gl_function("glGetGraphicsResetStatusARB"))
                      : nullptr;
}

bool WindowTarget::is_lost() {
  make_current();
  return reset_status_ && reset_status_() != 0;
}

void WindowTarget::make_current() { glfwMakeContextCurrent(handle_); }

bool WindowTarget::is_current() const { return glfwGetCurrentContext() == handle_; }

void* WindowTarget::gl_function(const char* name) const { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

void WindowTarget::follow_size() {
  int width = 0, height = 0;
  glfwGetFramebufferSize(handle_, &width, &height);
  if (width > 0 && height > 0) window().SetSize(width, height);  // a minimised window has no pixels
}

void WindowTarget::present() { glfwSwapBuffers(handle_); }

}  // namespace nextview
