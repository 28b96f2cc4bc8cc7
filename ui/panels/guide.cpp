#include "ui/panels/guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ui/commands/file_commands.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

void draw_step(const PanelContext& context, const char* number, const char* text) {
  ImGui::PushFont(context.style.semi_bold);
  ImGui::TextUnformatted(number);
  ImGui::PopFont();
  ImGui::SameLine(context.style.px(30));
  ImGui::TextWrapped("%s", text);
}

/// What holds of what is open.
std::array<const char*, 3> steps(const SessionSnapshot& s) {
  constexpr const char* ask = "At the right stands why this view is next. Click anything in the scene to ask about it.";
  if (!s.loaded())
    return {"Open a mesh, recorded scans or a kept session: Ctrl+O, or drop it here.",
            "Then Space takes the first view.", "F1 shows every key, Ctrl+P every command."};
  if (s.records.empty() && !s.finished.empty())
    return {"This is a map, without a scan. Ctrl+O opens a part or recorded scans, or drop them here.",
            "Click a voxel to ask about it; F3 chooses what is shown, and its colours.",
            "F1 shows every key, Ctrl+P every command."};
  if (s.is_recording())
    return {"These scans were recorded: their frames are the candidates, and nothing is captured anew.",
            "Space adds the frame that is expected to show most, P goes on until all are used.", ask};
  if (s.live)
    return {"The scanner is connected. What stands before it is scanned.",
            "Space moves it to the next view and takes that, P goes on until the surface is complete.", ask};
  return {"This is what is scanned. Ctrl+O opens your own part, or drop its file here.",
          "Space takes the next view, P goes on until the surface is complete.", ask};
}

void draw_first_button(const PanelContext& context) {
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return command_button(context, command::open, Icon::none, "Open…", true);
  if (!s.finished.empty()) return;
  const std::string what = fmt::format("{} the {} {}", s.is_recording() ? "Add" : "Take",
                                       s.records.empty() ? "first" : "next", s.is_recording() ? "frame" : "view");
  command_button(context, command::step, Icon::step, what.c_str(), true);
}

/// Who scanned yesterday goes on where that ended.
void draw_last_session(const PanelContext& context, const EarlierSession& last) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Go on with   ").x;
  const std::string label = "Go on with " + shortened(last.name, room);
  if (icon_button(context.style, Icon::none, label.c_str())) context.post(command::open(last.folder.string()));
  tooltip("The last scan: " + last.folder.string());
  small_text(context.style, last.summary());
}

}  // namespace

void draw_guide(const PanelContext& context, const Rectangle& scene) {
  const WindowState& window = context.window;
  const bool is_asked = !context.progress.question.empty(), is_opening = context.progress.opening;
  if (!window.shows_guide(context.snapshot) || is_asked || (is_opening && !context.snapshot.loaded())) return;
  const Style& style = context.style;
  const bool has_room = float(scene.width) >= style.px(420) && float(scene.height) >= style.px(260);
  if (!has_room && !window.guide_asked) return;              // the scene needs what room there is
  const float margin = style.px(12), width = style.px(250);  // of the legends to come: the object is framed beside them
  ImGui::SetNextWindowPos({float(scene.x + scene.width) - margin, float(scene.y) + margin}, ImGuiCond_Always,
                          {1.0f, 0.0f});
  ImGui::SetNextWindowSize({std::min(width, float(scene.width) - 2 * margin), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::Begin("First steps", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushFont(style.small);
  const std::array<const char*, 3> texts = steps(context.snapshot);
  for (std::size_t k = 0; k < texts.size(); ++k) draw_step(context, std::to_string(k + 1).c_str(), texts[k]);
  ImGui::PopFont();
  ImGui::Spacing();
  draw_first_button(context);
  if (window.last_session && context.snapshot.records.empty()) draw_last_session(context, *window.last_session);
  if (icon_button(style, Icon::none, "Hide this")) context.post(command::guide());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nextview
