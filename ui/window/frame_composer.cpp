#include "ui/window/frame_composer.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "ui/render_target/gl_constants.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {
namespace {

/// Each box costs a blit and draws its windows once more; a pixel too many costs little.
constexpr std::size_t max_boxes = 8;
constexpr int close = 32;  // [px]

bool touch(const PixelBox& a, const PixelBox& b) {
  return a.left < b.right + close && b.left < a.right + close && a.bottom < b.top + close && b.bottom < a.top + close;
}

/// Of what ImGui's OpenGL backend draws of a command, rounded as it does; `height` of the window [px].
PixelBox scissor(const ImVec4& clip, int height) {
  const int left = int(clip.x), bottom = int(float(height) - clip.w);
  return {left, bottom, left + int(clip.z - clip.x), bottom + int(clip.w - clip.y)};
}

/// The clip rectangle that gives this scissor.
ImVec4 clip_rectangle(const PixelBox& box, int height) {
  return {float(box.left), float(height - box.top), float(box.right), float(height - box.bottom)};
}

/// The list's commands within the boxes.
ImVector<ImDrawCmd> commands_within(const std::vector<PixelBox>& boxes, const ImDrawList& list, int height) {
  ImVector<ImDrawCmd> result;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    for (const PixelBox& box : boxes) {
      const PixelBox common = scissor(command.ClipRect, height).intersection(box);
      if (command.ElemCount == 0 || common.empty()) continue;
      result.push_back(command);
      result.back().ClipRect = clip_rectangle(common, height);
    }
  }
  return result;
}

}  // namespace

PixelBox PixelBox::intersection(const PixelBox& o) const {
  return {std::max(left, o.left), std::max(bottom, o.bottom), std::min(right, o.right), std::min(top, o.top)};
}

PixelBox PixelBox::hull(const PixelBox& o) const {
  return {std::min(left, o.left), std::min(bottom, o.bottom), std::max(right, o.right), std::max(top, o.top)};
}

void PixelBoxes::add(PixelBox box) {
  if (box.empty()) return;
  const auto takes = [&](const PixelBox& other) { return touch(box, other) || boxes_.size() >= max_boxes; };
  for (auto other = boxes_.begin(); (other = std::find_if(boxes_.begin(), boxes_.end(), takes)) != boxes_.end();) {
    box = box.hull(*other);
    boxes_.erase(other);
  }
  boxes_.push_back(box);
}

std::size_t PixelBoxes::pixels() const {
  std::size_t sum = 0;
  for (const PixelBox& box : boxes_) sum += std::size_t(box.right - box.left) * std::size_t(box.top - box.bottom);
  return sum;
}

bool FrameComposer::Triangle::operator==(const Triangle& other) const {
  static_assert(sizeof(Triangle) == 20 * sizeof(float), "there must be no padding");
  return std::memcmp(this, &other, sizeof(Triangle)) == 0;
}

FrameComposer::FrameComposer(RenderTarget& target)
    : target_(target), frame_(vtkSmartPointer<vtkOpenGLFramebufferObject>::New()) {
  target.window().SetFrameBlitModeToNoBlit();
  frame_->SetContext(&target.window());
}

FrameComposer::~FrameComposer() {
  target_.make_current();
  frame_->ReleaseGraphicsResources(&target_.window());
}

std::vector<FrameComposer::Triangle> FrameComposer::triangles_of(const ImDrawList& list) {
  std::vector<Triangle> triangles;
  triangles.reserve(std::size_t(list.IdxBuffer.Size) / 3);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4& clip = command.ClipRect;
    Triangle triangle{{}, {clip.x, clip.y, clip.z, clip.w}, std::uint32_t(std::uintptr_t(command.GetTexID()))};
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
    for (unsigned int i = 0; i < command.ElemCount; i += 3) {
      for (unsigned int c = 0; c < 3; ++c) {
        const ImDrawVert& v = vertices[indices[i + c]];
        triangle.corners[c] = {v.pos.x, v.pos.y, v.uv.x, v.uv.y, v.col};
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// All that it may draw.
PixelBox FrameComposer::pixels(const Triangle& triangle) const {
  const auto [left, right] = std::minmax({triangle.corners[0].x, triangle.corners[1].x, triangle.corners[2].x});
  const auto [upper, lower] = std::minmax({triangle.corners[0].y, triangle.corners[1].y, triangle.corners[2].y});
  const auto& clip = triangle.clip;
  const int width = size_[0], height = size_[1];
  const auto in_window = [](float place, int end) { return int(std::clamp(place, 0.0f, float(end))); };
  const PixelBox box{in_window(std::floor(left), width), height - in_window(std::ceil(lower), height),
                     in_window(std::ceil(right), width), height - in_window(std::floor(upper), height)};
  return box.intersection(scissor({clip[0], clip[1], clip[2], clip[3]}, height));
}

void FrameComposer::damage(const Window& window) {
  for (const Triangle& triangle : window.triangles) damage_.add(pixels(triangle));
}

/// A pixel is the same if the same triangles cover it in the same order.
void FrameComposer::damage_difference(const Window& before, const Window& now) {
  const auto &a = before.triangles, &b = now.triangles;
  const auto begin = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto end =
      std::mismatch(a.rbegin(), std::reverse_iterator(begin.first), b.rbegin(), std::reverse_iterator(begin.second));
  const auto to_a = end.first.base(), to_b = end.second.base();
  const bool pairs = to_a - begin.first == to_b - begin.second;
  for (auto [at_a, at_b] = begin; pairs && at_a != to_a; ++at_a, ++at_b) {
    if (*at_a == *at_b) continue;
    damage_.add(pixels(*at_a));
    damage_.add(pixels(*at_b));
  }
  for (auto at = begin.first; !pairs && at != to_a; ++at) damage_.add(pixels(*at));
  for (auto at = begin.second; !pairs && at != to_b; ++at) damage_.add(pixels(*at));
}

/// Windows that were and are, in the same order, are compared; the others are damage as a whole.
void FrameComposer::damage_differences(const std::vector<Window>& now) {
  auto before = windows_.begin();
  for (const Window& window : now) {
    const auto same = std::find_if(before, windows_.end(), [&](const Window& w) { return w.name == window.name; });
    if (same == windows_.end()) {
      damage(window);
      continue;
    }
    for (; before != same; ++before) damage(*before);
    damage_difference(*before++, window);
  }
  for (; before != windows_.end(); ++before) damage(*before);
}

bool FrameComposer::compose(ImDrawData& panels, const std::optional<Rectangle>& new_scene, bool new_pictures) {
  std::vector<Window> windows;
  for (int i = 0; i < panels.CmdListsCount; ++i) {
    const ImDrawList& list = *panels.CmdLists[i];
    windows.push_back({list._OwnerName ? list._OwnerName : "", triangles_of(list)});
  }
  damage_ = {};
  const std::array<int, 2> size{target_.width(), target_.height()};
  const PixelBox all{0, 0, size[0], size[1]};
  if (size_ != size) {
    size_ = size;
    damage_.add(all);
  } else {
    damage_differences(windows);
    if (const auto& r = new_scene) {
      const PixelBox scene{int(std::floor(r->x)), int(std::floor(size[1] - r->y - r->height)),
                           int(std::ceil(r->x + r->width)), int(std::ceil(size[1] - r->y))};
      damage_.add(scene.intersection(all));
    }
    const auto letters = std::uint32_t(std::uintptr_t(ImGui::GetIO().Fonts->TexID));
    for (const Window& window : windows) {
      for (const Triangle& triangle : window.triangles)
        if (new_pictures && triangle.texture != letters) damage_.add(pixels(triangle));
    }
  }
  windows_ = std::move(windows);
  if (damage_.all().empty()) return false;
  draw(panels);
  fill_back_buffer();
  return true;
}

void FrameComposer::draw(ImDrawData& panels) {
  vtkGenericOpenGLRenderWindow& window = target_.window();
  target_.make_current();
  if (frame_->GetFBOIndex() == 0) {
    frame_->PopulateFramebuffer(size_[0], size_[1], true, 1, VTK_UNSIGNED_CHAR, false, 0, 0);
  } else {
    frame_->Resize(size_[0], size_[1]);
  }
  vtkOpenGLState& state = *window.GetState();
  state.PushFramebufferBindings();
  frame_->Bind(gl_draw_framebuffer);
  frame_->ActivateDrawBuffer(0);
  for (const PixelBox& box : damage_.all()) {
    const int width = box.right - box.left, height = box.top - box.bottom;
    window.BlitDisplayFramebuffer(0, box.left, box.bottom, width, height, box.left, box.bottom, width, height,
                                  gl_color_buffer_bit, gl_nearest);
  }
  // The backend takes all lists that it is given to the graphics card, so it gets only those that it is to draw.
  std::vector<ImDrawList*> lists;
  std::vector<ImVector<ImDrawCmd>> uncut;
  for (int i = 0; i < panels.CmdListsCount; ++i) {
    ImVector<ImDrawCmd> commands = commands_within(damage_.all(), *panels.CmdLists[i], size_[1]);
    if (commands.empty()) continue;
    lists.push_back(panels.CmdLists[i]);
    lists.back()->CmdBuffer.swap(commands);
    uncut.push_back(commands);
  }
  ImDrawData within = panels;
  within.CmdLists = lists.data();
  within.CmdListsCount = int(lists.size());
  ImGui_ImplOpenGL3_RenderDrawData(&within);
  for (std::size_t i = 0; i < lists.size(); ++i) lists[i]->CmdBuffer.swap(uncut[i]);
  state.PopFramebufferBindings();
}

void FrameComposer::fill_back_buffer() {
  target_.make_current();
  vtkOpenGLState& state = *target_.window().GetState();
  state.PushReadFramebufferBinding();
  frame_->Bind(gl_read_framebuffer);
  frame_->ActivateReadBuffer(0);
  state.vtkglBindFramebuffer(gl_draw_framebuffer, 0);
  state.vtkglDrawBuffer(gl_back);
  state.vtkglBlitFramebuffer(0, 0, size_[0], size_[1], 0, 0, size_[0], size_[1], gl_color_buffer_bit, gl_nearest);
  state.PopReadFramebufferBinding();
}

Image FrameComposer::read() {
  target_.make_current();
  vtkOpenGLState& state = *target_.window().GetState();
  state.PushReadFramebufferBinding();
  frame_->Bind(gl_read_framebuffer);
  frame_->ActivateReadBuffer(0);
  Image image = target_.read_pixels();
  state.PopReadFramebufferBinding();
  return image;
}

}  // namespace nextview
