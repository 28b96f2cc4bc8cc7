#include "ui/window/panels_alone.hpp"

#include <imgui_internal.h>

#include <string_view>

namespace nextview {
namespace {

/// Panels are the windows that never come to the front.
bool is_in_its_place(const ImDrawList& list) {
  if (!list._OwnerName || std::string_view(list._OwnerName) == "##Background") return true;
  const ImGuiWindow* window = ImGui::FindWindowByName(list._OwnerName);
  return window && (window->RootWindow->Flags & ImGuiWindowFlags_NoBringToFrontOnFocus);
}

}  // namespace

PanelsAlone::PanelsAlone(const ImDrawData& frame) : data_(frame) {
  for (int i = 0; i < frame.CmdListsCount; ++i)
    if (is_in_its_place(*frame.CmdLists[i])) lists_.push_back(frame.CmdLists[i]);
  data_.CmdLists = lists_.data();
  data_.CmdListsCount = int(lists_.size());
}

}  // namespace nextview
