#pragma once
#include <vector>

#include "ui/render_target/render_target.hpp"

namespace nextview {

/// An image in memory: OpenGL 3.3 core through OSMesa. Needs no display; the process must draw headless
/// (ensure_headless).
class OffscreenTarget : public RenderTarget {
 public:
  /// Sizes in pixels.
  /// @throws std::runtime_error if the process does not draw headless or OSMesa gives no context.
  OffscreenTarget(int width, int height);
  ~OffscreenTarget() override;

  void make_current() override;
  bool is_current() const override;
  void* gl_function(const char* name) const override;

 private:
  void replace_context() override;

  void* context_ = nullptr;
  std::vector<unsigned char> buffer_;  ///< OSMesa's back buffer
};

}  // namespace nextview
