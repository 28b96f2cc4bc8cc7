#pragma once
#include <imgui.h>

#include <vector>

namespace nextview {

/// Of a frame only the panels in their places and what is drawn beneath them: no menu, list, palette, sheet of keys,
/// notice or tooltip. The frame must live longer.
class PanelsAlone {
 public:
  explicit PanelsAlone(const ImDrawData& frame);
  ImDrawData& data() { return data_; }

 private:
  std::vector<ImDrawList*> lists_;
  ImDrawData data_;
};

}  // namespace nextview
