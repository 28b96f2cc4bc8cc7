#include "ui/panels/palette.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <sstream>

#include "core/file/lower_case.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// The command that a text begins with, if it goes on after its name.
const Command* named_by(const std::string& text) {
  for (const Command& command : commands())
    if (text.size() > command.name.size() && text.starts_with(command.name) && text[command.name.size()] == ' ')
      return &command;
  return nullptr;
}

/// What stands after the last space.
std::string last_word(const std::string& text) { return text.substr(text.rfind(' ') + 1); }

std::size_t values_before_last(const std::string& text) {
  std::istringstream words(text);
  std::string word;
  std::size_t count = 0;
  while (words >> word) ++count;
  return count - 1 - (text.back() == ' ' ? 0 : 1);
}

/// At the end of the text, where the user goes on.
int to_end(ImGuiInputTextCallbackData* data) {
  if (*static_cast<bool*>(data->UserData)) {
    data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
    *static_cast<bool*>(data->UserData) = false;
  }
  return 0;
}

}  // namespace

std::vector<const Command*> matching_commands(std::string_view text) {
  std::istringstream words(lower_case(text));
  std::vector<std::string> wanted;
  for (std::string word; words >> word;) wanted.push_back(word);
  std::vector<std::pair<int, const Command*>> found;
  for (const Command& command : commands()) {
    const std::string all = command.name + " " + lower_case(command.text) + " " + lower_case(command.help);
    const bool matches =
        std::all_of(wanted.begin(), wanted.end(), [&](const std::string& w) { return all.find(w) != all.npos; });
    if (!matches) continue;
    const std::string first = wanted.empty() ? "" : wanted.front();
    const int rank = command.name == first                                                        ? 0
                     : command.name.starts_with(first)                                            ? 1
                     : (command.name + lower_case(command.text)).find(first) != std::string::npos ? 2
                                                                                                  : 3;
    found.emplace_back(rank, &command);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Command*> result;
  for (const auto& [rank, command] : found) result.push_back(command);
  return result;
}

void Palette::put(std::string text) {
  text_ = std::move(text);
  put_ = true;
  chosen_ = 0;
  error_.clear();
}

/// Does what the text says; what is missing or wrong is said instead.
void Palette::run(const PanelContext& context) {
  try {
    CommandCall call = parse_call(text_);
    const Command& command = *call.command;
    const std::string reason = command.why_not_now(context.state());
    if (!reason.empty()) throw std::invalid_argument(reason);
    if (&command != &command::palette) context.post(command::palette());  // before a demo, which begins without it
    context.post(std::move(call));
  } catch (const std::invalid_argument& error) {
    error_ = error.what();
  }
}

void Palette::draw_commands(const PanelContext& context) {
  const auto found = matching_commands(text_);
  if (ImGui::IsKeyPressed(static_cast<int>(Key::down))) ++chosen_;
  if (ImGui::IsKeyPressed(static_cast<int>(Key::up)) && chosen_ > 0) --chosen_;
  chosen_ = std::min(chosen_, std::max<std::size_t>(found.size(), 1) - 1);
  const bool enter = ImGui::IsKeyPressed(static_cast<int>(Key::enter), false);
  const Style& style = context.style;
  ImGui::BeginChild("found", {0, std::min(style.px(300), room_)});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Command& command = *found[i];
    const bool can = command.available(context.state());
    ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(can ? theme::ink : theme::muted));
    const bool pressed = ImGui::Selectable(fmt::format("{}##{}", command.text, command.name).c_str(), i == chosen_);
    ImGui::PopStyleColor();
    tooltip(help_of(context, command));
    if (i == chosen_ &&
        (ImGui::IsKeyPressed(static_cast<int>(Key::down)) || ImGui::IsKeyPressed(static_cast<int>(Key::up))))
      ImGui::SetScrollHereY();
    const float name_at = std::max(style.px(300), ImGui::CalcTextSize(command.text.c_str()).x + style.px(16));
    ImGui::PushFont(style.small);
    const std::string keys = command.keys();
    const float keys_at = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(keys.c_str()).x - style.px(6);
    if (name_at + ImGui::CalcTextSize(command.name.c_str()).x + style.px(10) < keys_at) {  // else there is no room
      ImGui::SameLine(name_at);
      ImGui::TextDisabled("%s", command.name.c_str());
    }
    ImGui::SameLine(keys_at);
    ImGui::TextDisabled("%s", keys.c_str());
    ImGui::PopFont();
    if (!pressed && !(enter && i == chosen_)) continue;
    put(command.needs_no_value() ? command.name : command.name + " ");
    if (command.needs_no_value()) run(context);
  }
  if (found.empty()) ImGui::TextDisabled("No command is called that.");
  ImGui::EndChild();
}

void Palette::draw_values(const PanelContext& context, const Command& command) {
  const Style& style = context.style;
  small_text(style, command.usage());
  small_text(style, command.help);
  const std::size_t at = values_before_last(text_);
  const std::string begun = last_word(text_);
  ImGui::BeginChild("values", {0, std::min(style.px(240), room_)});
  if (at < command.arguments().size()) {
    const Argument& argument = command.arguments()[at];
    ImGui::TextUnformatted(fmt::format("{}: {}", argument.name, argument.help).c_str());
    if (argument.choices) {
      for (const std::string& value : argument.choices(context.snapshot)) {
        if (!begun.empty() && value.find(begun) == value.npos) continue;
        if (ImGui::Selectable(value.c_str()))
          put(text_.substr(0, text_.rfind(' ') + 1) + value + (at + 1 < command.arguments().size() ? " " : ""));
      }
    }
  }
  ImGui::EndChild();
  if (ImGui::IsKeyPressed(static_cast<int>(Key::enter), false)) run(context);
}

void Palette::draw(const PanelContext& context, const Rectangle& scene) {
  const bool opened = context.window.palette_open && !open_;
  const bool started = context.window.palette_open && !context.window.palette_text.empty() && text_.empty();
  open_ = context.window.palette_open;
  if (!open_) {
    text_.clear();
    return;
  }
  if (opened || started) put(context.window.palette_text);
  const Style& style = context.style;
  ImGui::SetNextWindowPos({float(scene.x + scene.width / 2), float(scene.y) + style.px(12)}, ImGuiCond_Always,
                          {0.5f, 0});
  ImGui::SetNextWindowSize({std::max(std::min(style.px(620), float(scene.width) - style.px(24)), style.px(80)), 0});
  const float others = 4 * ImGui::GetFrameHeightWithSpacing();
  room_ = std::max(ImGui::GetIO().DisplaySize.y - float(scene.y) - style.px(12) - others, style.px(30));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::Begin("Commands", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
  if (opened) ImGui::SetWindowFocus();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (opened || put_) ImGui::SetKeyboardFocusHere();
  if (ImGui::InputTextWithHint("##palette", "A command, or a line of a script", &text_,
                               ImGuiInputTextFlags_CallbackAlways, to_end, &put_)) {
    chosen_ = 0;
    error_.clear();
  }
  if (!error_.empty()) small_text(style, error_, theme::chosen);
  if (const Command* command = named_by(text_)) {
    draw_values(context, *command);
  } else {
    draw_commands(context);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nextview
