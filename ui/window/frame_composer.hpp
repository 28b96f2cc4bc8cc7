#pragma once
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ui/panels/layout.hpp"
#include "ui/render_target/image.hpp"

class vtkOpenGLFramebufferObject;
struct ImDrawData;
struct ImDrawList;

namespace nextview {

class RenderTarget;

/// Pixels of the window: from the left edge and from the lower edge, as OpenGL counts them.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;  ///< [px] right and top are outside

  bool empty() const { return right <= left || top <= bottom; }
  PixelBox intersection(const PixelBox& other) const;
  PixelBox hull(const PixelBox& other) const;  ///< the smallest box around both
};

/// Boxes that do not overlap. There are few of them: those that are close to each other become one.
class PixelBoxes {
 public:
  void add(PixelBox box);
  const std::vector<PixelBox>& all() const { return boxes_; }
  std::size_t pixels() const;

 private:
  std::vector<PixelBox> boxes_;
};

/// Puts the panels over the scene's picture, drawing only those pixels again that differ from the last frame. The
/// picture is the same as if all of it were drawn.
class FrameComposer {
 public:
  /// From now on VTK draws the scene into its own framebuffer only. The target must live longer.
  explicit FrameComposer(RenderTarget& target);
  ~FrameComposer();
  FrameComposer(const FrameComposer&) = delete;
  FrameComposer& operator=(const FrameComposer&) = delete;

  /// The next frame is drawn whole.
  void forget() { size_ = {}; }
  /// Composes a frame in the target's back buffer, if it differs from the last one; returns whether it does.
  /// `new_scene` is where the scene was drawn anew; `new_pictures` tells that other textures than that of the letters
  /// may have changed.
  bool compose(ImDrawData& panels, const std::optional<Rectangle>& new_scene, bool new_pictures);
  /// Gives the back buffer the last frame again: after it was shown nobody knows what it has.
  void fill_back_buffer();
  /// The last frame, also where it is larger than the back buffer.
  Image read();
  /// That were drawn again for the last frame.
  const PixelBoxes& drawn() const { return damage_; }

 private:
  /// A triangle of a panel, with all that its pixels depend on.
  struct Triangle {
    struct Corner {
      float x, y, u, v;
      std::uint32_t colour;
    };
    std::array<Corner, 3> corners;
    std::array<float, 4> clip;
    std::uint32_t texture;

    bool operator==(const Triangle& other) const;
  };
  /// What one of ImGui's windows draws.
  struct Window {
    std::string name;
    std::vector<Triangle> triangles;
  };

  static std::vector<Triangle> triangles_of(const ImDrawList& list);
  PixelBox pixels(const Triangle& triangle) const;
  void damage(const Window& window);
  void damage_difference(const Window& before, const Window& now);
  void damage_differences(const std::vector<Window>& now);
  void draw(ImDrawData& panels);

  RenderTarget& target_;
  vtkSmartPointer<vtkOpenGLFramebufferObject> frame_;  ///< keeps what was drawn, which a back buffer does not
  std::array<int, 2> size_{};                          ///< of the last frame [px]; 0: there is none
  std::vector<Window> windows_;                        ///< of the last frame, the lowest first
  PixelBoxes damage_;
};

}  // namespace nextview
