#include "ui/panels/guide.hpp"

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

void draw_steps(const PanelContext& context) {
  if (context.snapshot.loaded()) {
    draw_step(context, "1", "This is what is scanned. Ctrl+O opens your own part, or drop its file here.");
    draw_step(context, "2", "Space takes the next view, P goes on until the surface is complete.");
    draw_step(context, "3", "At the right stands why this view is next. Click anything in the scene to ask about it.");
  } else {
    draw_step(context, "1", "Open a mesh, recorded scans or a kept session: Ctrl+O, or drop it here.");
    draw_step(context, "2", "Then Space takes the first view.");
    draw_step(context, "3", "F1 shows every key, Ctrl+P every command.");
  }
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
  const SessionSnapshot& s = context.snapshot;
  const bool is_asked = !context.progress.question.empty(), is_opening = context.progress.opening;
  const bool is_begun = !s.records.empty() || !s.finished.empty();  // a map alone is finished without a view
  if (!context.window.guide_open || is_begun || is_asked || (is_opening && !s.loaded())) return;
  const Style& style = context.style;
  const float margin = style.px(12), width = style.px(250);  // of the legends to come: the object is framed beside them
  if (float(scene.width) < style.px(420) || float(scene.height) < style.px(260))
    return;  // the scene needs what room there is
  ImGui::SetNextWindowPos({float(scene.x + scene.width) - margin, float(scene.y) + margin}, ImGuiCond_Always,
                          {1.0f, 0.0f});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::Begin("First steps", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushFont(style.small);
  draw_steps(context);
  ImGui::PopFont();
  ImGui::Spacing();
  if (s.loaded())
    command_button(context, command::step, Icon::step, "Take the first view", true);
  else
    command_button(context, command::open, Icon::none, "Open…", true);
  if (context.window.last_session) draw_last_session(context, *context.window.last_session);
  if (icon_button(style, Icon::none, "Hide this")) context.post(command::guide());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nextview
