#include "ui/render_target/offscreen_target.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/memory/available_memory.hpp"
#include "core/memory/startable_threads.hpp"
#include "ui/render_target/headless.hpp"

namespace nextview {
namespace {

/// What OSMesa, LLVM and VTK take until the first picture is drawn [bytes]. They do not survive it if they cannot.
constexpr std::uint64_t drawing_bytes = std::uint64_t{384} << 20;

/// llvmpipe draws with a thread a core, and some more: for those that cannot be started it would wait without end.
void require_drawing_threads() {
  const int needed = static_cast<int>(std::thread::hardware_concurrency()) + 3, startable = startable_threads(needed);
  if (startable < needed)
    throw std::runtime_error(fmt::format(
        "drawing pictures needs {} threads, {} can be started: raise the limit (ulimit -u), or use --no-pictures",
        needed, startable));
}

/// OSMesa's functions come from the preloaded library; the program itself does not link OSMesa.
template <class Function>
Function osmesa(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
}

void* new_context() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_STENCIL_BITS,
                            8,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  void* context = osmesa<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs")(attributes, nullptr);
  if (!context) throw std::runtime_error("cannot draw into memory: OSMesa gives no OpenGL 3.3 core context");
  return context;
}

void destroy(void* context) {
  osmesa<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")(static_cast<OSMesaContext>(context));
}

}  // namespace

OffscreenTarget::OffscreenTarget(int width, int height) : buffer_(std::size_t(width) * height * 4) {
  if (!drawing_headless()) {
    throw std::runtime_error("cannot draw into memory: this process was not started to draw headless");
  }
  require_memory(drawing_bytes, "drawing pictures", "raise the limit (ulimit -v), or use --no-pictures");
  require_drawing_threads();
  context_ = new_context();
  start(width, height);
}

OffscreenTarget::~OffscreenTarget() {
  finish();
  destroy(context_);
}

void OffscreenTarget::replace_context() {
  void* const another = new_context();
  destroy(std::exchange(context_, another));
}

void OffscreenTarget::make_current() {
  const auto make_current = osmesa<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
  buffer_.resize(std::max(buffer_.size(), std::size_t(width()) * height() * 4));  // a picture may be larger
  if (!make_current(static_cast<OSMesaContext>(context_), buffer_.data(), GL_UNSIGNED_BYTE, width(), height())) {
    throw std::runtime_error(fmt::format("cannot draw into memory: OSMesa takes no {} x {} pixels", width(), height()));
  }
}

bool OffscreenTarget::is_current() const {
  return osmesa<decltype(&OSMesaGetCurrentContext)>("OSMesaGetCurrentContext")() == context_;
}

void* OffscreenTarget::gl_function(const char* name) const {
  return reinterpret_cast<void*>(osmesa<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress")(name));
}

}  // namespace nextview
