#include "ui/panels/question.hpp"

#include <algorithm>

#include "ui/commands/scanner_commands.hpp"

namespace nextview {
namespace {

/// What the colours of the clouds in the scene mean, in a line, or more if there is no room.
void draw_colours(const PanelContext& context, const DoubtfulScan& scan) {
  const Style& style = context.style;
  const float size = style.px(10), gap = style.px(6), between = style.px(14);
  float right = 0;  // of the entry before, in the window
  const auto entry = [&](const char* text, const Colour& colour) {
    const float width = size + gap + ImGui::CalcTextSize(text).x;
    if (right > 0 && right + between + width < ImGui::GetWindowContentRegionMax().x) ImGui::SameLine(right + between);
    right = ImGui::GetCursorPosX() + width;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float y = corner.y + (ImGui::GetTextLineHeight() - size) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, y}, {corner.x + size, y + size}, to_imgui_u32(colour),
                                              style.px(2));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + size + gap);
    ImGui::TextUnformatted(text);
  };
  ImGui::PushFont(style.small);
  entry("scanned so far", theme::cloud);
  entry("this scan", theme::new_scan);
  if (!scan.corrected.empty()) entry("corrected", theme::corrected_scan);
  ImGui::PopFont();
}

/// What an answer does, and its key.
std::string help_of(const WorkerProgress& progress, std::size_t answer) {
  const bool is_last = answer + 1 == progress.answers.size(), is_usual = answer == progress.usual_answer();
  const std::string key = is_usual && is_last ? "Enter, Esc" : is_usual ? "Enter" : is_last ? "Esc" : "";
  if (answer >= progress.effects.size()) return key;
  return progress.effects[answer] + (key.empty() ? "" : " [" + key + "]");
}

}  // namespace

void draw_question(const PanelContext& context, const Rectangle& scene) {
  const std::string& question = context.progress.question;
  if (question.empty()) return;
  const Style& style = context.style;
  const float width = std::min(style.px(420), float(scene.width) - style.px(16));
  const DoubtfulScan* const doubtful = context.progress.doubtful.get();
  // In a corner that neither axes nor legends take: what it is about is seen in the scene.
  ImGui::SetNextWindowPos({float(scene.x + scene.width) - style.px(8), float(scene.y + scene.height) - style.px(8)},
                          ImGuiCond_Always, {1.0f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(20), style.px(16)));
  ImGui::Begin("Question", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  wrapped_text(question);
  if (doubtful) draw_colours(context, *doubtful);
  ImGui::Dummy({0, style.px(8)});
  const std::vector<std::string>& answers = context.progress.answers;
  // What was pressed for the question before answers nothing, nor does the second click of a double click.
  ImGui::PushID(int(context.progress.question_number));
  const bool is_second =
      ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] > 1;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const Icon icon = i + 1 == answers.size() ? Icon::cancel : i == 0 ? Icon::play : Icon::none;
    const bool is_usual = i == context.progress.usual_answer();
    if (icon_button(style, icon, answers[i].c_str(), is_usual) && !is_second)
      context.post(answer_to(context.progress, answers[i]));
    tooltip(help_of(context.progress, i));
  }
  ImGui::PopID();
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview
