#include "ui/window/window.hpp"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>

#include "core/session/untitled_sessions.hpp"
#include "ui/render_target/window_target.hpp"
#include "ui/window/behind_drawing.hpp"
#include "ui/window/interface.hpp"
#include "ui/window/window_preferences.hpp"

namespace nextview {
namespace {

constexpr int width = 1280, height = 800, min_width = 480, min_height = 360;  // [screen coordinates]
constexpr int exit_not_done = 2;                                              // a call of the script was not done
/// The longest wait while nothing happens [s]; news and input end it at once.
constexpr double longest_wait = 60.0;

std::optional<Key> key_of(int glfw_key) {
  if (glfw_key >= GLFW_KEY_SPACE && glfw_key <= GLFW_KEY_Z) return static_cast<Key>(glfw_key);
  if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12)
    return static_cast<Key>(static_cast<int>(Key::f1) + glfw_key - GLFW_KEY_F1);
  switch (glfw_key) {
    case GLFW_KEY_TAB:
      return Key::tab;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return Key::enter;
    case GLFW_KEY_ESCAPE:
      return Key::escape;
    case GLFW_KEY_BACKSPACE:
      return Key::backspace;
    case GLFW_KEY_DELETE:
      return Key::del;
    case GLFW_KEY_LEFT:
      return Key::left;
    case GLFW_KEY_RIGHT:
      return Key::right;
    case GLFW_KEY_UP:
      return Key::up;
    case GLFW_KEY_DOWN:
      return Key::down;
    case GLFW_KEY_HOME:
      return Key::home;
    case GLFW_KEY_END:
      return Key::end;
    case GLFW_KEY_PAGE_UP:
      return Key::page_up;
    case GLFW_KEY_PAGE_DOWN:
      return Key::page_down;
    case GLFW_KEY_LEFT_CONTROL:
    case GLFW_KEY_RIGHT_CONTROL:
      return Key::control;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
      return Key::shift;
    case GLFW_KEY_LEFT_ALT:
    case GLFW_KEY_RIGHT_ALT:
      return Key::alt;
    default:
      return std::nullopt;
  }
}

/// Framebuffer pixels a screen coordinate.
double pixels_per_coordinate(GLFWwindow* window) {
  int framebuffer = 0, screen = 0, ignored = 0;
  glfwGetFramebufferSize(window, &framebuffer, &ignored);
  glfwGetWindowSize(window, &screen, &ignored);
  return screen > 0 ? double(framebuffer) / screen : 1.0;
}

Interface& interface_of(GLFWwindow* window) { return *static_cast<Interface*>(glfwGetWindowUserPointer(window)); }

void on_move(GLFWwindow* window, double x, double y) {
  const double scale = pixels_per_coordinate(window);
  interface_of(window).push(input::Move{x * scale, y * scale});
}

void on_button(GLFWwindow* window, int button, int action, int) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  interface_of(window).push(input::Button{static_cast<PointerButton>(button), action == GLFW_PRESS});
}

void on_wheel(GLFWwindow* window, double, double steps) { interface_of(window).push(input::Wheel{steps}); }

void on_key(GLFWwindow* window, int glfw_key, int, int action, int) {
  const auto key = key_of(glfw_key);
  // Of a key that is held, too: what repeats it draws only when something comes.
  if (key) interface_of(window).push(input::KeyChange{*key, action != GLFW_RELEASE});
}

void on_text(GLFWwindow* window, unsigned int character) { interface_of(window).push(input::Text{character}); }

/// Parts of the window were covered, so the display has to be given them again.
void on_refresh(GLFWwindow* window) { interface_of(window).push(input::Expose{}); }

void on_drop(GLFWwindow* window, int count, const char** files) {
  if (count > 0) interface_of(window).push(input::Drop{files[0], std::size_t(count)});
}

/// What a window is told once it is open.
void prepare(GLFWwindow* window, Interface& interface) {
  glfwSetWindowSizeLimits(window, min_width, min_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window, &interface);
  glfwSetCursorPosCallback(window, on_move);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetScrollCallback(window, on_wheel);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_text);
  glfwSetDropCallback(window, on_drop);
  glfwSetWindowRefreshCallback(window, on_refresh);
  interface.set_clipboard({[window] {
                             const char* text = glfwGetClipboardString(window);
                             return std::string(text ? text : "");
                           },
                           [window](const std::string& text) { glfwSetClipboardString(window, text.c_str()); }});
}

/// The usual size; on a large display two thirds of it, on a small one what there is.
std::array<int, 2> first_size() {
  int x = 0, y = 0, wide = width, high = height;
  if (!glfwInit()) return {width, height};  // there will be a message when the window is opened
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &wide, &high);
  const auto within = [](int usual, int there_is) {
    return there_is > 0 ? std::min(std::max(usual, 2 * there_is / 3), there_is) : usual;
  };
  return {within(width, wide), within(height, high)};
}

/// Beside the scale that the display asks for itself.
double text_scale_of_display(float content_scale) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  int wide = 0, high = 0;
  if (monitor) glfwGetMonitorPhysicalSize(monitor, &wide, &high);
  return content_scale > 1.0f || !mode ? 1.0 : usual_text_scale(mode->width, mode->height, wide);
}

/// The window on the whole screen, or where it was before.
class FullScreen {
 public:
  void set(GLFWwindow* window, bool wanted) {
    if (wanted == is_) return;
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (wanted && !mode) return;
    is_ = wanted;
    if (!wanted) return glfwSetWindowMonitor(window, nullptr, x_, y_, width_, height_, GLFW_DONT_CARE);
    glfwGetWindowPos(window, &x_, &y_);
    glfwGetWindowSize(window, &width_, &height_);
    glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }

 private:
  bool is_ = false;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;
};

/// Counts the calls of a script that were not done, and tells each.
class ScriptErrors {
 public:
  explicit ScriptErrors(std::string file) : file_(std::move(file)) {}
  void add(const ScriptFailure& failure) {
    const std::string place = failure.line > 0 ? fmt::format("{}:{}", file_, failure.line) : "nextview";
    fmt::print(stderr, "{}: {}\n", place, failure.reason);
    ++count_;
  }
  bool any() const { return count_ > 0; }

 private:
  std::string file_;
  int count_ = 0;
};

/// Makes again what a reset took. Who loses it at once again is not helped by a third window.
void renew(WindowTarget& target, Interface& interface) {
  interface.renew_target();
  prepare(target.handle(), interface);
  if (target.is_lost())
    throw std::runtime_error("the graphics driver lost what is drawn, twice; the session is kept: start again");
}

/// Draws a frame, also if the graphics card is reset before or meanwhile. Whether there is something new to show.
bool draw(WindowTarget& target, Interface& interface, double seconds) {
  if (target.is_lost()) renew(target, interface);
  try {
    return interface.draw(seconds);
  } catch (const std::runtime_error&) {
    if (!target.is_lost()) throw;
    renew(target, interface);
    return false;
  }
}

void run(WindowTarget& target, Interface& interface, const std::function<bool()>& has_to_end) {
  std::string title;
  const GLFWwindow* entitled = nullptr;
  FullScreen full_screen;
  double last = glfwGetTime();
  const auto seconds_left = [&] { return interface.seconds_to_next_frame() - (glfwGetTime() - last); };
  while (!interface.wants_to_quit() && !has_to_end()) {
    if (const double seconds = seconds_left(); seconds > 0) {
      glfwWaitEventsTimeout(std::min(seconds, longest_wait));
    } else {
      glfwPollEvents();
    }
    if (glfwWindowShouldClose(target.handle())) {
      glfwSetWindowShouldClose(target.handle(), GLFW_FALSE);
      interface.ask_to_quit();
    }
    full_screen.set(target.handle(), interface.state().full_screen);
    target.follow_size();
    if (seconds_left() > 0) continue;
    const double now = glfwGetTime();
    if (draw(target, interface, now - last)) target.present();
    last = now;
    if (interface.title() == title && entitled == target.handle()) continue;
    title = interface.title();
    entitled = target.handle();
    glfwSetWindowTitle(target.handle(), title.c_str());
  }
}

}  // namespace

int run_window(const Configuration& configuration, const Script& script, const WindowStart& start) {
  const auto [first_width, first_height] = first_size();
  WindowTarget target("Nextview", first_width, first_height);
  float scale = 1.0f, ignored = 1.0f;
  glfwGetWindowContentScale(target.handle(), &scale, &ignored);
  const auto has_news = [] {  // called by those that compute
    stay_behind_drawing();
    glfwPostEmptyEvent();
  };
  SessionWorker worker(has_news);
  if (!script.demo) worker.keep_sessions(state_folder());
  InspectionWorker inspector(has_news);
  Interface interface(target, worker, inspector, scale * text_scale_of_display(scale));
  ScriptErrors errors(script.file);
  interface.script().set_on_failure([&](const ScriptFailure& failure) { errors.add(failure); });
  if (start.scanner)
    interface.connect(*start.scanner);
  else if (!start.session.empty())
    interface.open_session(start.session);
  else if (!script.demo)
    interface.open(configuration);
  if (const auto unfinished = start.offer ? unfinished_session(state_folder()) : std::nullopt)
    interface.offer(*unfinished);
  if (start.offer) interface.set_last_session(last_session(state_folder()));
  if (!start.record.empty()) interface.record(start.record);
  const WindowPreferences before = read_preferences(state_folder());
  interface.set_preferences(before);
  if (!script.calls.empty()) interface.show_guide(false);
  script.demo ? interface.play_demo(script.calls) : interface.run_script(script.calls);
  prepare(target.handle(), interface);
  run(target, interface, [&] { return script.stop_on_error && errors.any(); });
  WindowPreferences after = interface.preferences();
  if (!script.calls.empty()) after = {after.text_scale, before.guide, before.dark, before.place_sizes};
  if (after != before) keep_preferences(state_folder(), after);
  interface.stop_recording();  // last: its file may be one that cannot be written any more
  if (!script.stop_on_error || !errors.any()) interface.script().give_up("not done: the program ended before");
  return errors.any() ? exit_not_done : 0;
}

}  // namespace nextview
