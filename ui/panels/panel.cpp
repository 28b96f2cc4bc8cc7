#include "ui/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/colour_map.hpp"

namespace nextview {
namespace {

constexpr float tooltip_delay = 0.45f;  // [s] so that a tooltip does not cover what a person is about to click

}  // namespace

Panel::Panel(const char* name, const Rectangle& r, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos({float(r.x), float(r.y)});
  ImGui::SetNextWindowSize({float(r.width), float(r.height)});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | flags);
}

Panel::~Panel() { ImGui::End(); }

void heading(const Style& style, const char* text) {
  ImGui::PushFont(style.semi_bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void small_text(const Style& style, const std::string& text, const Colour& colour) {
  ImGui::PushFont(style.small);
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(colour));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

double seconds_to_tooltip(const ImGuiContext& imgui) {
  if (imgui.HoveredId == 0 || imgui.HoveredIdTimer >= tooltip_delay) return std::numeric_limits<double>::infinity();
  return tooltip_delay - imgui.HoveredIdTimer;
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (ImGui::GetCurrentContext()->HoveredIdTimer < tooltip_delay) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float wrap = ImGui::GetFontSize() * 20, gap = style.ItemSpacing.y;
  const ImVec2 padding = style.WindowPadding, display = ImGui::GetIO().DisplaySize;
  const ImVec2 inside = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 size(inside.x + 2 * padding.x, inside.y + 2 * padding.y);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const float below = to.y + gap, y = below + size.y < display.y ? below : from.y - gap - size.y;
  ImGui::SetNextWindowPos({std::clamp(from.x, gap, std::max(gap, display.x - size.x - gap)), y});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + padding.x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

namespace {

void draw_reset(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
  constexpr float start = -0.9f, end = 4.1f;  // [rad] an open circle with an arrow head
  list.PathArcTo(c, r * 0.85f, start, end, 24);
  list.PathStroke(colour, 0, r * 0.28f);
  const ImVec2 tip(c.x + r * 0.85f * std::cos(start), c.y + r * 0.85f * std::sin(start));
  list.AddTriangleFilled({tip.x - 0.62f * r, tip.y - 0.18f * r}, {tip.x + 0.42f * r, tip.y - 0.52f * r},
                         {tip.x + 0.28f * r, tip.y + 0.52f * r}, colour);
}

}  // namespace

void draw_icon(Icon icon, ImVec2 c, float size, ImU32 colour) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float r = size / 2;
  if (icon == Icon::reset) return draw_reset(list, c, r, colour);
  if (icon == Icon::play || icon == Icon::step) {
    const float shift = icon == Icon::step ? -0.25f * r : 0.1f * r;
    list.AddTriangleFilled({c.x - 0.7f * r + shift, c.y - r}, {c.x - 0.7f * r + shift, c.y + r},
                           {c.x + 0.9f * r + shift, c.y}, colour);
  }
  if (icon == Icon::step) list.AddRectFilled({c.x + 0.7f * r, c.y - r}, {c.x + r, c.y + r}, colour);
  if (icon == Icon::pause) {
    list.AddRectFilled({c.x - 0.8f * r, c.y - r}, {c.x - 0.2f * r, c.y + r}, colour);
    list.AddRectFilled({c.x + 0.2f * r, c.y - r}, {c.x + 0.8f * r, c.y + r}, colour);
  }
  if (icon == Icon::cancel) {
    list.AddLine({c.x - 0.7f * r, c.y - 0.7f * r}, {c.x + 0.7f * r, c.y + 0.7f * r}, colour, 0.3f * r);
    list.AddLine({c.x - 0.7f * r, c.y + 0.7f * r}, {c.x + 0.7f * r, c.y - 0.7f * r}, colour, 0.3f * r);
  }
  if (icon == Icon::warning) {
    list.AddTriangleFilled({c.x - r, c.y + 0.85f * r}, {c.x + r, c.y + 0.85f * r}, {c.x, c.y - 0.9f * r}, colour);
    const ImU32 mark = to_imgui_u32(theme::paper);
    list.AddLine({c.x, c.y - 0.35f * r}, {c.x, c.y + 0.3f * r}, mark, 0.24f * r);
    list.AddCircleFilled({c.x, c.y + 0.58f * r}, 0.15f * r, mark, 8);
  }
}

bool icon_button(const Style& style, Icon icon, const char* label, bool primary) {
  const float height = ImGui::GetFrameHeight() + style.px(4), glyph = style.px(11), padding = style.px(12);
  const ImVec2 size(ImGui::CalcTextSize(label).x + glyph + style.px(8) + 2 * padding, height);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Colour accent = theme::series[0];
  if (primary) {
    ImGui::PushStyleColor(ImGuiCol_Button, to_imgui(accent));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, to_imgui(mix(accent, theme::ink, 0.15)));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, to_imgui(mix(accent, theme::ink, 0.3)));
  }
  const std::string id = fmt::format("##{}", label);
  const bool pressed = ImGui::Button(id.c_str(), size);
  if (primary) ImGui::PopStyleColor(3);
  const ImU32 colour = ImGui::GetColorU32(to_imgui(primary ? theme::paper : theme::ink));
  const float middle = corner.y + height / 2;
  draw_icon(icon, {corner.x + padding + glyph / 2, middle}, glyph, colour);
  ImGui::GetWindowDrawList()->AddText(
      {corner.x + padding + glyph + style.px(8), std::floor(middle - ImGui::GetFontSize() / 2)}, colour, label);
  return pressed;
}

std::string readable(double value) {
  if (value == 0.0) return "0";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

}  // namespace nextview
