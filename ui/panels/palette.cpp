#include "ui/panels/palette.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

#include "core/config/configuration.hpp"
#include "core/file/lower_case.hpp"
#include "core/setting/quantity.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// A command's text that happens to begin with a name, as "refine the map" and "export a surface", is to be found, not
/// read as a line of a script.
bool is_searched_for(const std::string& text, const Command& named) {
  if (text.find('"') != text.npos) return false;
  std::istringstream words(text);
  const std::ptrdiff_t values = std::distance(std::istream_iterator<std::string>(words), {}) - 1;
  const bool is_begun = values > 1 && std::ranges::any_of(commands(), [&](const Command& command) {
                          return lower_case(command.text).find(lower_case(text)) != std::string::npos;
                        });
  return (is_begun || values > std::ssize(named.arguments())) && !found_in_palette(text).empty();
}

/// The command that a text begins with, if it goes on after its name.
const Command* named_by(const std::string& text) {
  for (const Command& command : commands())
    if (text.size() > command.name.size() && text.starts_with(command.name) && text[command.name.size()] == ' ')
      return is_searched_for(text, command) ? nullptr : &command;
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

/// Those of an argument's values that hold what was typed, first those that begin with it.
std::vector<std::string> values_with(const Argument& argument, const SessionSnapshot& snapshot,
                                     const std::string& begun) {
  if (!argument.choices) return {};
  std::vector<std::string> values = argument.choices(snapshot);
  std::erase_if(values, [&](const std::string& value) { return value.find(begun) == value.npos; });
  std::ranges::stable_partition(values, [&](const std::string& value) { return value.starts_with(begun); });
  return values;
}

/// Those that may stand where a text ends, which begins with a command's name.
std::vector<std::string> values_at_end(const std::string& text, const Command& command,
                                       const SessionSnapshot& snapshot) {
  const std::size_t at = values_before_last(text);
  if (at >= command.arguments().size()) return {};
  return values_with(command.arguments()[at], snapshot, last_word(text));
}

/// The text with such a value at its end, and a space where more is to come.
std::string with_value(const std::string& text, const Command& command, const std::string& value) {
  const bool is_last = values_before_last(text) + 1 >= command.arguments().size();
  return text.substr(0, text.rfind(' ') + 1) + value + (is_last ? "" : " ");
}

/// A script's lengths are metres, the field beside the palette shows millimetres: who types says which.
void require_unit(const std::vector<std::string>& key_and_value) {
  Configuration configuration;
  auto all = settings(configuration);
  const Setting& setting = find_setting(all, key_and_value.at(0));
  const std::string& text = key_and_value.at(1);
  double number = 0.0;
  const bool is_length = setting.unit == "m" && std::holds_alternative<double*>(setting.value);
  if (is_length && read_quantity(text, "", number) && number != 0.0)
    throw std::invalid_argument(fmt::format("{0} needs its unit: {1}mm, or {1}m?", setting.key, text));
}

}  // namespace

void Palette::put(std::string text) {
  text_ = std::move(text);
  put_ = true;
  forget_choice();
}

void Palette::forget_choice() {
  chosen_ = 0;
  is_chosen_ = false;
  error_.clear();
}

/// Moves the choice along a list by the arrow keys. Whether it moved.
bool Palette::choose_by_keys(std::size_t count) {
  const bool down = ImGui::IsKeyPressed(static_cast<int>(Key::down)),
             up = ImGui::IsKeyPressed(static_cast<int>(Key::up));
  if (down) ++chosen_;
  if (up && chosen_ > 0) --chosen_;
  chosen_ = std::min(chosen_, std::max<std::size_t>(count, 1) - 1);
  is_chosen_ |= down || up;
  return down || up;
}

/// Does what the text says; what is missing or wrong is said instead.
void Palette::run(const PanelContext& context) {
  try {
    CommandCall call = parse_call(text_);
    const Command& command = *call.command;
    const std::string reason = command.why_not_now(context.state());
    if (!reason.empty()) throw std::invalid_argument(reason);
    if (&command == &command::set) require_unit(call.values());
    if (&command != &command::palette) context.post(command::palette());  // before a demo, which begins without it
    context.post(std::move(call));
  } catch (const std::invalid_argument& error) {
    error_ = error.what();
    put_ = true;  // to be mended
  }
}

/// Its text, what it is called in scripts, if there is room, and its keys. Whether it was clicked.
bool Palette::draw_entry(const PanelContext& context, const PaletteEntry& entry, bool chosen) {
  const Style& style = context.style;
  const Command& command = *entry.command;
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(command.available(context.state()) ? theme::ink : theme::muted));
  const bool pressed = ImGui::Selectable(fmt::format("{}##{}", entry.text, entry.name()).c_str(), chosen);
  ImGui::PopStyleColor();
  tooltip(entry.setting.empty() ? help_of(context, command) : entry.help);
  const float name_at = std::max(style.px(300), ImGui::CalcTextSize(entry.text.c_str()).x + style.px(16));
  ImGui::PushFont(style.small);
  const std::string keys = entry.setting.empty() ? command.keys() : "";
  const float keys_at = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(keys.c_str()).x - style.px(6);
  if (name_at + ImGui::CalcTextSize(entry.name().c_str()).x + style.px(10) < keys_at) {  // else there is no room
    ImGui::SameLine(name_at);
    ImGui::TextDisabled("%s", entry.name().c_str());
  }
  ImGui::SameLine(keys_at);
  ImGui::TextDisabled("%s", keys.c_str());
  ImGui::PopFont();
  return pressed;
}

void Palette::draw_commands(const PanelContext& context) {
  const std::vector<PaletteEntry> found = found_in_palette(text_);
  const bool moved = choose_by_keys(found.size());
  const bool enter = ImGui::IsKeyPressed(static_cast<int>(Key::enter), false);
  const Style& style = context.style;
  ImGui::BeginChild("found", {0, std::min(style.px(300), room_)});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const PaletteEntry& entry = found[i];
    const bool pressed = draw_entry(context, entry, i == chosen_);
    if (i == chosen_ && moved) ImGui::SetScrollHereY();
    if (!pressed && !(enter && i == chosen_)) continue;
    put(entry.written());
    if (entry.needs_no_value()) run(context);
  }
  if (found.empty()) {
    ImGui::TextDisabled("No command is called that.");
    put_ |= enter;  // ImGui leaves the text
  }
  ImGui::EndChild();
}

/// What the setting is that `set` is to change, and how it is now.
void Palette::draw_setting(const PanelContext& context) const {
  std::istringstream words(text_);
  std::string command, key;
  words >> command >> key;
  Configuration configuration = context.snapshot.configuration;
  for (const Setting& setting : settings(configuration))
    if (setting.key == key)
      small_text(context.style, fmt::format("{}: {}; now {}", key, setting.explanation(), setting.text()));
}

void Palette::draw_values(const PanelContext& context, const Command& command) {
  const Style& style = context.style;
  small_text(style, command.usage());
  small_text(style, command.help);
  if (&command == &command::set) draw_setting(context);
  const std::size_t at = values_before_last(text_);
  const std::vector<std::string> values = values_at_end(text_, command, context.snapshot);
  const bool moved = choose_by_keys(values.size()), enter = ImGui::IsKeyPressed(static_cast<int>(Key::enter), false);
  std::optional<std::string> taken;
  const bool is_wanted = at < command.arguments().size() && !command.arguments()[at].optional && text_.back() == ' ';
  // Enter takes what the list shows as chosen, but proposes no file to write over.
  const bool takes = is_chosen_ || (is_wanted && command.arguments()[at].kind != Argument::Kind::file);
  if (enter && takes && !values.empty()) taken = values[chosen_];
  ImGui::BeginChild("values", {0, std::min(style.px(240), room_)});
  if (at < command.arguments().size()) {
    const Argument& argument = command.arguments()[at];
    const char* keys = values.empty() ? "" : " (Tab completes)";
    ImGui::TextUnformatted(fmt::format("{}: {}{}", argument.name, argument.help, keys).c_str());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (ImGui::Selectable(values[i].c_str(), i == chosen_)) taken = values[i];
      if (i == chosen_ && moved) ImGui::SetScrollHereY();
    }
  }
  ImGui::EndChild();
  if (taken)
    put(with_value(text_, command, *taken));
  else if (enter)
    run(context);
}

/// What Tab makes of a text: its last word becomes the value that is chosen in the list, or all of it the command.
std::string Palette::completed(const std::string& text, const PanelContext& context) const {
  if (const Command* command = named_by(text)) {
    const std::vector<std::string> values = values_at_end(text, *command, context.snapshot);
    return values.empty() ? text : with_value(text, *command, values[std::min(chosen_, values.size() - 1)]);
  }
  const std::vector<PaletteEntry> found = found_in_palette(text);
  return found.empty() ? text : found[std::min(chosen_, found.size() - 1)].written();
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
  struct Typing {
    Palette& palette;
    const PanelContext& context;
  } typing{*this, context};
  const auto on_typing = [](ImGuiInputTextCallbackData* data) {
    const auto& [palette, context] = *static_cast<Typing*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
      const std::string text = palette.completed({data->Buf, std::size_t(data->BufTextLen)}, context);
      data->DeleteChars(0, data->BufTextLen);
      data->InsertChars(0, text.c_str());
    } else if (palette.put_) {  // at the end, where the user goes on
      data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
      palette.put_ = false;
    }
    return 0;
  };
  if (ImGui::InputTextWithHint("##palette", "A command, or a line of a script", &text_,
                               ImGuiInputTextFlags_CallbackAlways | ImGuiInputTextFlags_CallbackCompletion, on_typing,
                               &typing))
    forget_choice();
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
