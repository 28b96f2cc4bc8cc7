#include "ui/panels/log_panel.hpp"

namespace nextview {

void draw_entry(const Style& style, const LogEntry& entry) {
  const bool warning = entry.level == LogEntry::Level::warning, success = entry.level == LogEntry::Level::success;
  const Colour colour = warning ? theme::chosen : success ? theme::series[2] : theme::ink;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float size = style.px(11), middle = corner.y + ImGui::GetTextLineHeight() / 2;
  if (warning) {
    draw_icon(Icon::warning, {corner.x + size / 2, middle}, size, to_imgui_u32(colour));
  } else {
    ImGui::GetWindowDrawList()->AddCircleFilled({corner.x + size / 2, middle}, style.px(3),
                                                to_imgui_u32(success ? colour : theme::hairline));
  }
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + size + style.px(8));
  small_text(style, entry.text, colour);
}

void LogPanel::draw(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Log", rectangle);
  ImGui::PushFont(context.style.small);
  for (const LogEntry& entry : context.log) draw_entry(context.style, entry);
  if (context.log.empty()) ImGui::TextDisabled("Nothing has happened yet.");
  if (shown_ != context.log.size()) ImGui::SetScrollHereY(1.0f);
  shown_ = context.log.size();
  ImGui::PopFont();
}

}  // namespace nextview
