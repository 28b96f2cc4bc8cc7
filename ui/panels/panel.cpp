#include "ui/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "core/setting/area_text.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

constexpr float tooltip_delay = 0.45f;  // [s] so that a tooltip does not cover what the user is about to click

}  // namespace

Panel::Panel(const char* name, const Rectangle& r, ImGuiWindowFlags flags, float min_width) {
  if (r.width < min_width) {
    ImGui::SetNextWindowContentSize({min_width - 2 * ImGui::GetStyle().WindowPadding.x, 0});
    flags |= ImGuiWindowFlags_HorizontalScrollbar;
  }
  ImGui::SetNextWindowPos({float(r.x), float(r.y)});
  ImGui::SetNextWindowSize({float(r.width), float(r.height)});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | flags);
}

Panel::~Panel() { ImGui::End(); }

void PanelContext::invoke(const Command& command) const {
  if (const std::string reason = command.why_not_now(state()); !reason.empty()) {
    const auto refuse = [&command, reason](CommandTarget&) {
      throw std::invalid_argument(fmt::format("{}: {}", command.name, reason));
    };
    return post({&command, refuse, [] { return std::vector<std::string>(); }});
  }
  if (command.takes_file() && !command.needs_no_value()) return post(command::file_dialog(command.name));
  post(command.needs_no_value() ? command.read({}) : command::palette(command.name + " "));
}

std::string help_of(const PanelContext& context, const Command& command) {
  std::string text = command.help;
  if (const std::string keys = command.keys(); !keys.empty()) text += " [" + keys + "]";
  const std::string reason = command.why_not_now(context.state());
  return reason.empty() ? text : text + "\nNot now: " + reason + ".";
}

bool pressed(Key key, bool repeats) { return ImGui::IsKeyPressed(static_cast<int>(key), repeats); }

void heading(const Style& style, const char* text) {
  ImGui::PushFont(style.semi_bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

namespace {

/// A number and its unit belong together: "12 %", "1.19 m", "214 cm²".
bool joins(const std::string& text, std::size_t space) {
  constexpr std::array<std::string_view, 14> units = {"%",          "mm", "cm", "m", "mm²",  "cm²",  "m²",
                                                      "nats/voxel", "s",  "px", "°", "nats", "Mbit", "GB"};
  if (space == 0 || !std::isdigit(static_cast<unsigned char>(text[space - 1]))) return false;
  const std::size_t end = text.find_first_of(" \n,.;:)", space + 1);
  return std::ranges::count(units, std::string_view(text).substr(space + 1, end - space - 1)) > 0;
}

/// With its lines broken at spaces alone. ImGui breaks them behind points, too: "1.19 m" came apart.
std::string broken_at_spaces(std::string text, float width) {
  std::size_t line = 0, space = std::string::npos;  // where it begins, and could be broken
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != ' ' && text[i] != '\n') continue;
    if (i < text.size() && text[i] == ' ' && joins(text, i)) continue;
    const bool fits = ImGui::CalcTextSize(&text[line], &text[i]).x <= width;
    if (!fits && space != std::string::npos) text[space] = '\n', line = space + 1;
    space = i;
    if (i < text.size() && text[i] == '\n') line = i + 1, space = std::string::npos;
  }
  return text;
}

}  // namespace

void wrapped_text(const std::string& text) {
  ImGui::TextWrapped("%s", broken_at_spaces(text, ImGui::GetContentRegionAvail().x).c_str());
}

void small_text(const Style& style, const std::string& text, const Colour& colour) {
  ImGui::PushFont(style.small);
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(colour));
  wrapped_text(text);
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

std::string shortened(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  constexpr const char* ellipsis = "…";
  std::string result = text;
  while (!result.empty() && ImGui::CalcTextSize((result + ellipsis).c_str()).x > width) {
    while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0xC0) == 0x80) result.pop_back();
    if (!result.empty()) result.pop_back();
  }
  return result + ellipsis;
}

namespace {

/// Who has clicked knows what it does, and who types looks elsewhere: until the pointer moves on, nothing is said,
/// whatever comes and goes above it.
bool wants_no_tooltip(const ImGuiContext& imgui) {
  static ImGuiID clicked = 0;
  static ImVec2 acted_at(-1, -1);
  const ImGuiIO& io = imgui.IO;
  const auto rests = [&] { return io.MousePos.x == acted_at.x && io.MousePos.y == acted_at.y; };
  if (imgui.HoveredId != clicked && !rests()) clicked = 0;
  const bool presses = io.MouseDown[ImGuiMouseButton_Left];
  if (presses) clicked = imgui.HoveredId;
  if (presses || std::ranges::find(io.KeysDown, true) != std::end(io.KeysDown)) acted_at = io.MousePos;
  return imgui.HoveredId == 0 || imgui.HoveredId == clicked || rests();
}

}  // namespace

bool tooltip_is_due(const ImGuiContext& imgui) {
  return !wants_no_tooltip(imgui) && imgui.HoveredIdTimer >= tooltip_delay;
}

double seconds_to_tooltip(const ImGuiContext& imgui) {
  if (wants_no_tooltip(imgui) || tooltip_is_due(imgui)) return std::numeric_limits<double>::infinity();
  return tooltip_delay - imgui.HoveredIdTimer;
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (imgui.HoveredId == 0) {  // plain text has no number by which ImGui would time it
    ImGui::SetHoveredID(ImGui::GetID(text.c_str()));
    imgui.HoveredIdAllowOverlap = true;
  }
  if (!tooltip_is_due(imgui)) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float wrap = ImGui::GetFontSize() * 20, gap = style.ItemSpacing.y;
  const ImVec2 padding = style.WindowPadding, display = ImGui::GetIO().DisplaySize;
  const std::string broken = broken_at_spaces(text, wrap);
  const ImVec2 inside = ImGui::CalcTextSize(broken.c_str(), nullptr, false, wrap);
  const ImVec2 size(inside.x + 2 * padding.x, inside.y + 2 * padding.y);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const float below = to.y + gap, y = below + size.y < display.y ? below : from.y - gap - size.y;
  ImGui::SetNextWindowPos({std::clamp(from.x, gap, std::max(gap, display.x - size.x - gap)), y});
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0f);  // of what is not available, too: it says why
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + padding.x);
  ImGui::TextUnformatted(broken.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool icon_button(const Style& style, Icon icon, const char* label, bool primary, float width) {
  const bool named = label[0] != '\0';
  const float height = ImGui::GetFrameHeight() + style.px(4), glyph = icon == Icon::none ? 0 : style.px(11);
  const float gap = icon == Icon::none || !named ? 0 : style.px(8), padding = style.px(named ? 12 : 9);
  const float content = ImGui::CalcTextSize(label).x + glyph + gap;
  const ImVec2 size(width > 0 ? width : content + 2 * padding, height);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Colour accent = theme::series[0];
  if (primary) {
    ImGui::PushStyleColor(ImGuiCol_Button, to_imgui(accent));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, to_imgui(mix(accent, theme::ink, 0.15)));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, to_imgui(mix(accent, theme::ink, 0.3)));
  }
  const std::string id = fmt::format("##{}{}", label, static_cast<int>(icon));
  const bool pressed = ImGui::Button(id.c_str(), size);
  if (primary) ImGui::PopStyleColor(3);
  const ImU32 colour = ImGui::GetColorU32(to_imgui(primary ? theme::paper : theme::ink));
  const float middle = corner.y + height / 2;
  const float left = corner.x + std::floor((size.x - content) / 2);
  draw_icon(icon, {left + glyph / 2, middle}, glyph, colour);
  ImGui::GetWindowDrawList()->AddText({left + glyph + gap, std::floor(middle - ImGui::GetFontSize() / 2)}, colour,
                                      label);
  return pressed;
}

void command_button(const PanelContext& context, const Command& command, Icon icon, const char* label, bool primary,
                    float width) {
  ImGui::BeginDisabled(!command.available(context.state()));
  if (icon_button(context.style, icon, label, primary, width)) context.invoke(command);
  ImGui::EndDisabled();
  tooltip(help_of(context, command));
}

std::optional<std::size_t> segmented(const PanelContext& context, const char* id, std::span<const char* const> names,
                                     std::size_t selected, std::span<const char* const> help) {
  std::optional<std::size_t> pressed;
  const float gap = context.style.px(2);
  const float width = (ImGui::GetContentRegionAvail().x - float(names.size() - 1) * gap) / float(names.size());
  ImGui::PushFont(context.style.small);
  ImGui::PushID(id);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    if (i == selected) {
      const ImVec4 fill = to_imgui(mix(theme::series[0], theme::paper, 0.78));
      for (const auto which : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
        ImGui::PushStyleColor(which, fill);
    }
    if (ImGui::Button(names[i], {width, 0})) pressed = i;
    if (i == selected) ImGui::PopStyleColor(3);
    if (i < help.size()) tooltip(help[i]);
  }
  ImGui::PopID();
  ImGui::PopFont();
  return pressed;
}

void table_row(const std::string& name, const std::string& value, const std::string& help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name.c_str());
  tooltip(help);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

std::string first_views(std::size_t count) {
  return count == 1 ? "the first view" : fmt::format("the first {} views", count);
}

std::string readable(double value) {
  if (value == 0.0) return "0";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string readable(double value, const std::string& unit) {
  if (unit == "cm²") return area_text(value);
  return unit.empty() ? readable(value) : fmt::format("{} {}", readable(value), unit);
}

}  // namespace nextview
