#include "ui/render_target/window_target.hpp"

#include <GLFW/glfw3.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <stdexcept>

namespace nextview {
namespace {

std::runtime_error no_window() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return std::runtime_error(std::string("cannot open a window: ") + (reason ? reason : "unknown reason") +
                            "; the subcommands draw without a display");
}

}  // namespace

WindowTarget::WindowTarget(const std::string& title, int width, int height) {
  if (!glfwInit()) throw no_window();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!handle_) {
    const auto error = no_window();
    glfwTerminate();
    throw error;
  }
  glfwGetFramebufferSize(handle_, &width, &height);
  start(width, height);
}

WindowTarget::~WindowTarget() {
  finish();
  glfwDestroyWindow(handle_);
  glfwTerminate();
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
