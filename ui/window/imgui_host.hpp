#pragma once
#include <span>
#include <string>

#include "ui/panels/style.hpp"
#include "ui/window/clipboard.hpp"
#include "ui/window/input.hpp"

namespace nextview {

/// ImGui's context, with our fonts and colours, and the input that it sees. It draws no pixels. There is one at a time.
class ImguiHost {
 public:
  explicit ImguiHost(double scale);
  ~ImguiHost();
  ImguiHost(const ImguiHost&) = delete;
  ImguiHost& operator=(const ImguiHost&) = delete;

  /// Makes text and controls of another size. @pre the context is current; the fonts' texture has to be made again
  void set_scale(double scale);
  /// Light text and controls on dark paper. @pre as above
  void set_dark(bool dark);
  void make_current() const;
  const Style& style() const { return style_; }
  const ImGuiContext& context() const { return *context_; }
  void set_clipboard(Clipboard clipboard);
  /// What the user did since the last frame; dropped files are nothing to ImGui.
  void take(std::span<const InputEvent> events);
  /// Begins a frame of this size [px], `seconds` after the last one.
  void begin_frame(int width, int height, double seconds);

 private:
  ImGuiContext* context_ = nullptr;
  Style style_;
  Clipboard clipboard_;
  std::string pasted_;
};

}  // namespace nextview
