#include "ui/window/presentation_drawing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "ui/commands/panel_list.hpp"

namespace nextview {
namespace {

ImVec2 size_of(ImFont& font, const std::string& text, float size) {
  return font.CalcTextSizeA(size, 1e9f, 0, text.data(), text.data() + text.size());
}

/// Broken between words where a line would be wider than this [px].
std::vector<std::string> lines_of(ImFont& font, const std::string& text, float size, float widest) {
  std::vector<std::string> lines;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    const char* stop = std::max(font.CalcWordWrapPositionA(size / font.FontSize, at, end, widest), at + 1);
    lines.emplace_back(at, stop);
    for (at = stop; at < end && *at == ' ';) ++at;
  }
  return lines;
}

/// Lines in the middle of a width, from `top` on [px].
void draw_lines(ImDrawList& list, ImFont& font, float size, const std::vector<std::string>& lines, float middle,
                float top, ImU32 colour) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float left = middle - size_of(font, lines[i], size).x / 2;
    list.AddText(&font, size, {float(int(left)), float(int(top + i * size))}, colour, lines[i].c_str());
  }
}

/// At most this size, and smaller where the place is small.
float fitting(const ImFont& font, const Rectangle& place, double share) {
  return std::min(font.FontSize, float(place.height * share));
}

/// On one line, smaller if there is no room for it.
void draw_caption(const Style& style, const ShownText& caption, const Rectangle& strip) {
  ImFont& font = *style.caption;
  float size = fitting(font, strip, 0.62);
  size = std::min(size, size * float(strip.width) * 0.95f / std::max(size_of(font, caption.text, size).x, 1.0f));
  draw_lines(*ImGui::GetBackgroundDrawList(), font, size, {caption.text}, float(strip.x + strip.width / 2),
             float(strip.y + (strip.height - size) / 2), to_imgui_u32(theme::paper, caption.opacity()));
}

void draw_title(const Style& style, const ShownText& title, const Layout& layout) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const Rectangle window{0, 0, layout.width, layout.height};
  const float opacity = float(title.opacity()), middle = float(layout.width / 2), widest = float(layout.width * 0.86);
  list.AddRectFilled({0, 0}, {float(layout.width), float(layout.height)}, to_imgui_u32(theme::paper, opacity));
  const float size = fitting(*style.title, window, 0.12), small = fitting(*style.caption, window, 0.06);
  const auto lines = lines_of(*style.title, title.text, size, widest);
  const auto beneath = lines_of(*style.caption, title.subtitle, small, widest);
  const float height = size * lines.size() + small * (0.6f + beneath.size());
  const float top = (float(layout.height) - height) / 2;
  draw_lines(list, *style.title, size, lines, middle, top, to_imgui_u32(theme::ink, opacity));
  draw_lines(list, *style.caption, small, beneath, middle, top + size * lines.size() + small * 0.6f,
             to_imgui_u32(theme::series[0], opacity));
}

void draw_highlight(const Style& style, const ShownText& highlight, const Layout& layout) {
  const Rectangle& r = layout.of(panel_info(highlight.text).side);
  if (r.empty()) return;
  const float inset = style.px(3);
  ImGui::GetForegroundDrawList()->AddRect(
      {float(r.x) + inset, float(r.y) + inset}, {float(r.x + r.width) - inset, float(r.y + r.height) - inset},
      to_imgui_u32(theme::chosen, highlight.opacity()), style.px(6), 0, style.px(5));
}

}  // namespace

void draw_presentation(const Style& style, const Presentation& presentation, const Layout& layout) {
  const Rectangle strip = layout.captions;
  if (!strip.empty())
    ImGui::GetBackgroundDrawList()->AddRectFilled({float(strip.x), float(strip.y)},
                                                  {float(strip.x + strip.width), float(strip.y + strip.height)},
                                                  to_imgui_u32(theme::ink));
  if (presentation.paused)
    return draw_caption(style, {"Paused: Space goes on, Right skips, Esc takes over", "", 1}, strip);
  for (const auto* caption : {&presentation.leaving_caption, &presentation.caption})
    if (*caption && (*caption)->opacity() > 0) draw_caption(style, **caption, strip);
  if (presentation.highlight) draw_highlight(style, *presentation.highlight, layout);
  if (presentation.title) draw_title(style, *presentation.title, layout);
}

}  // namespace nextview
