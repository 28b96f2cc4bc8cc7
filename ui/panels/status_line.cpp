#include "ui/panels/status_line.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/file/counted.hpp"
#include "core/setting/area_text.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// Without what was measured by a clock if it is to look the same every time.
std::string last_step(const SessionSnapshot& s, bool with_seconds) {
  if (!s.loaded()) return "";
  if (s.records.empty()) return s.setup->start_map ? "No view taken yet" : "Nothing measured yet";
  const StepRecord& r = s.records.back();
  const double seconds = r.seconds.sense + r.seconds.clean + r.seconds.insert + r.seconds.evaluate + r.seconds.score;
  const std::string text =
      fmt::format("View {}: {}, {} of new surface", r.step, counted(r.points, "point"), area_text(r.new_surface));
  return with_seconds ? fmt::format("{}, {:.2f} s", text, seconds + r.seconds.refine) : text;
}

std::string scanned(const SessionSnapshot& s) {
  if (!s.loaded()) return "";
  const std::string of = s.is_recording() ? " · " + counted(s.candidates.size(), "frame")
                         : s.mesh         ? " · " + counted(s.mesh->triangles.size(), "triangle")
                                          : "";
  return fmt::format("{}{} · {} × {} × {} voxels of {:g} mm", s.object_name, of, s.grid.size.x(), s.grid.size.y(),
                     s.grid.size.z(), 1e3 * s.grid.resolution);
}

/// In the unit that the scene's labels have, so that a caliper can be held beside it.
std::string coordinates(const Vector3& point) {
  const bool in_millimetres = point.cwiseAbs().maxCoeff() < 1.0;
  const double steps = in_millimetres ? 1e4 : 1e3;          // a metre
  const Vector3 p = (steps * point).array().round() + 0.0;  // 0 has no sign
  return in_millimetres ? fmt::format("x {:.1f}  y {:.1f}  z {:.1f} mm", p.x() / 10, p.y() / 10, p.z() / 10)
                        : fmt::format("x {:.3f}  y {:.3f}  z {:.3f} m", p.x() / 1e3, p.y() / 1e3, p.z() / 1e3);
}

/// What failed last, until it is clicked or something else was done.
void draw_message(const PanelContext& context, float width, float y) {
  const Style& style = context.style;
  const std::string& message = context.snapshot.message;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  draw_icon(Icon::warning, {corner.x + style.px(7), corner.y + ImGui::GetTextLineHeight() / 2}, style.px(14),
            to_imgui_u32(theme::chosen));
  ImGui::SetCursorPos({style.px(36), y});
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(theme::chosen));
  ImGui::TextUnformatted(shortened(message, width - style.px(50)).c_str());
  ImGui::PopStyleColor();
  if (ImGui::IsItemClicked()) context.post(command::dismiss());
  tooltip(message + "\nA click takes it away; the log keeps it.");
}

void draw_last_step(const PanelContext& context, float width, float y) {
  const Style& style = context.style;
  const SessionSnapshot& s = context.snapshot;
  const std::string right = context.window.pointed_at ? coordinates(*context.window.pointed_at) : scanned(s);
  const float right_x = width - style.px(16) - ImGui::CalcTextSize(right.c_str()).x;
  std::string left = last_step(s, !context.window.presentation.demo);
  if (const auto& recording = context.window.recording)
    left = fmt::format("Recording {} · {}", std::filesystem::path(recording->file).filename().string(), left);
  if (s.keeping_fails) left = "Nothing is kept: Ctrl+E exports · " + left;
  const bool room_for_both = style.px(14 + 24) + ImGui::CalcTextSize(left.c_str()).x < right_x;
  ImGui::TextDisabled("%s", shortened(left, width - style.px(28)).c_str());
  if (!room_for_both) return;
  ImGui::SetCursorPos({right_x, y});
  ImGui::TextDisabled("%s", right.c_str());
}

}  // namespace

void draw_status_line(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Status", rectangle, ImGuiWindowFlags_NoScrollbar);
  const Style& style = context.style;
  ImGui::PushFont(style.small);
  const float y = (float(rectangle.height) - ImGui::GetTextLineHeight()) / 2;
  ImGui::SetCursorPos({style.px(14), y});
  const auto draw = command::dismiss.available(context.state()) ? draw_message : draw_last_step;
  draw(context, float(rectangle.width), y);
  ImGui::PopFont();
}

}  // namespace nextview
