#include "ui/panels/question.hpp"

#include <algorithm>

#include "ui/commands/scanner_commands.hpp"

namespace nextview {

void draw_question(const PanelContext& context, const Rectangle& scene) {
  const std::string& question = context.progress.question;
  if (question.empty()) return;
  const Style& style = context.style;
  const float width = std::min(style.px(420), float(scene.width) - style.px(16));
  ImGui::SetNextWindowPos({float(scene.x + scene.width / 2), float(scene.y + scene.height / 2)}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(20), style.px(16)));
  ImGui::Begin("Question", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextWrapped("%s", question.c_str());
  ImGui::Dummy({0, style.px(8)});
  const std::vector<std::string>& answers = context.progress.answers;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const Icon icon = i + 1 == answers.size() ? Icon::cancel : Icon::play;
    if (icon_button(style, icon, answers[i].c_str(), i == 0)) context.post(command::answer(answers[i]));
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview
