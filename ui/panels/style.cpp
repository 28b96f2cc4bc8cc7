#include "ui/panels/style.hpp"

#include <utility>

#include "ui/appearance/colour_map.hpp"
#include "ui/drawing/text.hpp"

namespace nextview {
namespace {

/// Line heights [px]: ImGui's measure of a font. Inter's letters are of size 14 and 12.5 then.
constexpr float text_size = 17.0f, small_size = 15.0f, caption_size = 38.0f, title_size = 72.0f;

/// Latin, Greek, punctuation, superscripts, arrows, mathematical signs: what people and file names write.
constexpr ImWchar characters[] = {0x20,   0x24F,  0x370,  0x3FF,  0x2010, 0x2044, 0x2070,
                                  0x208E, 0x2190, 0x21FF, 0x2200, 0x22FF, 0};

/// Of what is large, fewer: an atlas of all would be large, too.
constexpr ImWchar large_characters[] = {0x20, 0xFF, 0x2010, 0x2026, 0x2190, 0x2193, 0x2248, 0x2265, 0};

ImFont* add_large_font(TextWeight weight, float size) {
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(font_file(weight).c_str(), size, nullptr, large_characters);
}

ImFont* add_font(TextWeight weight, float size) {
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = false;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(font_file(weight).c_str(), size, &config, characters);
}

ImVec4 as_is(const Colour& colour, double opacity = 1.0) {
  return {float(colour[0]), float(colour[1]), float(colour[2]), float(opacity)};
}

}  // namespace

void set_colours(bool dark) {
  ImGuiStyle& style = ImGui::GetStyle();
  const Colour accent = theme::series[0];
  const Colour quiet = mix(theme::sky, theme::hairline, 0.35), hovered = mix(quiet, theme::soft_ink, 0.12),
               pressed = mix(quiet, theme::soft_ink, 0.25);
  const Colour selected = mix(accent, theme::paper, 0.84), selected_hovered = mix(accent, theme::paper, 0.90);
  const std::pair<ImGuiCol, Colour> colours[] = {
      {ImGuiCol_Text, theme::ink},
      {ImGuiCol_TextDisabled, theme::soft_ink},
      {ImGuiCol_WindowBg, theme::paper},
      {ImGuiCol_PopupBg, theme::paper},
      {ImGuiCol_Border, theme::hairline},
      {ImGuiCol_FrameBg, theme::sky},
      {ImGuiCol_FrameBgHovered, quiet},
      {ImGuiCol_FrameBgActive, hovered},
      {ImGuiCol_ScrollbarBg, theme::paper},
      {ImGuiCol_ScrollbarGrab, theme::hairline},
      {ImGuiCol_ScrollbarGrabHovered, hovered},
      {ImGuiCol_ScrollbarGrabActive, theme::soft_ink},
      {ImGuiCol_CheckMark, accent},
      {ImGuiCol_Button, quiet},
      {ImGuiCol_ButtonHovered, hovered},
      {ImGuiCol_ButtonActive, pressed},
      {ImGuiCol_Header, selected},
      {ImGuiCol_HeaderHovered, selected_hovered},
      {ImGuiCol_HeaderActive, selected},
      {ImGuiCol_Separator, theme::hairline},
      {ImGuiCol_MenuBarBg, theme::paper},
      {ImGuiCol_SliderGrab, mix(accent, theme::paper, 0.7)},  // the value stands on it
      {ImGuiCol_SliderGrabActive, mix(accent, theme::paper, 0.55)},
      {ImGuiCol_PlotHistogram, accent},
      {ImGuiCol_TableHeaderBg, theme::sky},
      {ImGuiCol_TableBorderStrong, theme::hairline},
      {ImGuiCol_TableBorderLight, theme::hairline},
      {ImGuiCol_NavHighlight, accent},
      {ImGuiCol_TextSelectedBg, mix(accent, theme::paper, 0.7)},
      {ImGuiCol_TitleBg, theme::sky},
      {ImGuiCol_TitleBgActive, theme::sky},
  };
  for (const auto& [which, colour] : colours) style.Colors[which] = as_is(dark ? on_dark(colour) : colour);
  style.Colors[ImGuiCol_TableRowBg] = style.Colors[ImGuiCol_TableRowBgAlt] = ImVec4(0, 0, 0, 0);
  style.Colors[ImGuiCol_ModalWindowDimBg] = as_is(dark ? Colour{} : theme::ink, dark ? 0.5 : 0.25);
}

/// They are kept nowhere but in ImGui's context.
bool is_dark() { return ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x < 0.5f; }

Style apply_style(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsLight(&style);
  set_colours(false);
  style.WindowPadding = {14, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {7, 4};
  style.CellPadding = {6, 3};
  style.ScrollbarSize = 10;
  style.WindowRounding = style.ChildRounding = 0;
  style.FrameRounding = style.PopupRounding = 4;
  style.ScrollbarRounding = 5;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.45f;
  style.ScaleAllSizes(scale);
  style.WindowMinSize = {1, 1};  // the menu and the status line are lower than ImGui's 32 pixels
  Style result;
  result.scale = scale;
  result.regular = add_font(TextWeight::regular, text_size * scale);
  result.semi_bold = add_font(TextWeight::semi_bold, text_size * scale);
  result.small = add_font(TextWeight::regular, small_size * scale);
  result.caption = add_large_font(TextWeight::semi_bold, caption_size * scale);
  result.title = add_large_font(TextWeight::semi_bold, title_size * scale);
  return result;
}

ImVec4 to_imgui(const Colour& colour, double opacity) { return as_is(is_dark() ? on_dark(colour) : colour, opacity); }

ImU32 scene_colour_u32(const Colour& colour) { return ImGui::ColorConvertFloat4ToU32(as_is(colour)); }

ImU32 to_imgui_u32(const Colour& colour, double opacity) {
  return ImGui::ColorConvertFloat4ToU32(to_imgui(colour, opacity));
}

}  // namespace nextview
